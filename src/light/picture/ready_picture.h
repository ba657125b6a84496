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

struct ReadyPicture {
  ReadySurfaces seen;       ///< by the camera
  Reflections reflections;  ///< of those
  ReadySurfaces mirrored;   ///< what `reflections` met; nothing where they are none
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

/// Derives all of `picture` but the surfaces that the camera sees, which are given. Reuses memory. Parallel;
/// the same bits for any number of threads.
void makeReady(const OutlookSources& sources, ReadyPicture* picture);

}  // namespace sunlit::light
