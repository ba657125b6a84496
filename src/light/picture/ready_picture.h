/// All that a picture's light needs beside the light: made once a pose, used for all its conditions.
#pragma once

#include "light/picture/bodies/body_light.h"
#include "light/picture/gather/final_gather.h"
#include "light/picture/mirror/reflections.h"
#include "light/picture/outlook/outlook.h"
#include "light/picture/table/light_table.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"
#include "sunlit/light/world.h"

namespace sunlit::light {

/// Surfaces with all that is derived of them.
struct ReadySurfaces {
  Surfaces surfaces;
  Outlooks outlooks;
  LightTable table;
};

/// What smooth surfaces mirror.
struct ReadyMirrors {
  Reflections reflections;
  ReadySurfaces met;  ///< by the rays of `reflections`
};

struct ReadyPicture {
  /// A mirror in a mirror in a mirror shows the mean of what is around it.
  static constexpr std::size_t kMostMirrors = 3;

  ReadySurfaces seen;  ///< by the camera
  /// Of those, then each of what the one before met; ends where nothing mirrors by rays.
  std::vector<ReadyMirrors> mirrors;
};

/// Who tells what surfaces have around them.
struct OutlookSources {
  const World& world;
  const Visibility& visibility;       ///< of `world`, with its bodies where they stand
  const BodyLight* bodies = nullptr;  ///< of `world`; null: none stand in the picture
  FinalGather* gather = nullptr;      ///< null: the sky is seen as baked
};

/// Parallel; the same bits for any number of threads.
void findOutlooks(const Surfaces& surfaces, const OutlookSources& sources, Outlooks* outlooks);

/// Derives all of `picture` but the surfaces that the camera sees, which are given. Reuses memory but of
/// mirrors. Parallel; the same bits for any number of threads.
void makeReady(const OutlookSources& sources, ReadyPicture* picture);

}  // namespace sunlit::light
