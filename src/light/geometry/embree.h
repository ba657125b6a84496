/// Embree 3 and 4 by one face. Of 4 nothing is used that 3 has not.
#pragma once

#if SUNLIT_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

namespace sunlit::light {

#if SUNLIT_EMBREE == 3

/// What filter functions are given of the query that they are called for.
using RayContext = RTCIntersectContext;
constexpr auto kCoherent = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
constexpr auto kIncoherent = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;

inline void begin(RayContext* context) {
  rtcInitIntersectContext(context);
}

inline void intersect(RTCScene scene, RayContext* context, RTCRayHit* ray) {
  rtcIntersect1(scene, context, ray);
}

/// Rays of a packet that take much the same way, or do not.
template <auto coherence>
void intersect(const int* valid, RTCScene scene, RTCRayHit16* packet) {
  RayContext context;
  begin(&context);
  context.flags = coherence;
  rtcIntersect16(valid, scene, &context, packet);
}
template <auto coherence>
void occluded(const int* valid, RTCScene scene, RTCRay8* packet) {
  RayContext context;
  begin(&context);
  context.flags = coherence;
  rtcOccluded8(valid, scene, &context, packet);
}
template <auto coherence>
void occluded(const int* valid, RTCScene scene, RTCRay16* packet) {
  RayContext context;
  begin(&context);
  context.flags = coherence;
  rtcOccluded16(valid, scene, &context, packet);
}

#else

using RayContext = RTCRayQueryContext;
constexpr auto kCoherent = RTC_RAY_QUERY_FLAG_COHERENT;
constexpr auto kIncoherent = RTC_RAY_QUERY_FLAG_INCOHERENT;

inline void begin(RayContext* context) {
  rtcInitRayQueryContext(context);
}

inline void intersect(RTCScene scene, RayContext* context, RTCRayHit* ray) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = context;
  rtcIntersect1(scene, ray, &arguments);
}

template <auto coherence>
void intersect(const int* valid, RTCScene scene, RTCRayHit16* packet) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = coherence;
  rtcIntersect16(valid, scene, packet, &arguments);
}
template <auto coherence>
void occluded(const int* valid, RTCScene scene, RTCRay8* packet) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags = coherence;
  rtcOccluded8(valid, scene, packet, &arguments);
}
template <auto coherence>
void occluded(const int* valid, RTCScene scene, RTCRay16* packet) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags = coherence;
  rtcOccluded16(valid, scene, packet, &arguments);
}

#endif

}  // namespace sunlit::light
