/// Embree 3 and 4 by one face. Of 4 nothing is used that 3 has not.
#pragma once

#if SUNLIT_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

namespace sunlit::light {

/// What filter functions are given of the query that they are called for.
#if SUNLIT_EMBREE == 3
using RayContext = RTCIntersectContext;
#else
using RayContext = RTCRayQueryContext;
#endif

/// Besides what filters the geometries have, hits must pass that of the query, which is given its context.
struct QueryFilter {
  RTCFilterFunctionN filter;
  RayContext* context;  ///< begun
};

#if SUNLIT_EMBREE == 3

constexpr auto kCoherent = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
constexpr auto kIncoherent = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;

inline void begin(RayContext* context) {
  rtcInitIntersectContext(context);
}

inline void intersect(RTCScene scene, RayContext* context, RTCRayHit* ray) {
  rtcIntersect1(scene, context, ray);
}

/// What a scene needs whose queries bring a filter.
constexpr auto kFilterOfQuery = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

inline void intersect(const int* valid, RTCScene scene, const QueryFilter& query, RTCRayHit16* packet) {
  query.context->flags = kIncoherent;
  query.context->filter = query.filter;
  rtcIntersect16(valid, scene, query.context, packet);
}

/// Asks `query` for a packet.
template <auto coherence, auto query, typename Packet>
void ask(const int* valid, RTCScene scene, Packet* packet) {
  RayContext context;
  begin(&context);
  context.flags = coherence;
  query(valid, scene, &context, packet);
}

#else

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

constexpr auto kFilterOfQuery = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

inline void intersect(const int* valid, RTCScene scene, const QueryFilter& query, RTCRayHit16* packet) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = static_cast<RTCRayQueryFlags>(kIncoherent | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
  arguments.context = query.context;
  arguments.filter = query.filter;
  rtcIntersect16(valid, scene, packet, &arguments);
}

inline void begin(RTCIntersectArguments* arguments) {
  rtcInitIntersectArguments(arguments);
}
inline void begin(RTCOccludedArguments* arguments) {
  rtcInitOccludedArguments(arguments);
}

template <auto coherence, typename Packet, typename Arguments>
void ask(void (*query)(const int*, RTCScene, Packet*, Arguments*), const int* valid, RTCScene scene,
         Packet* packet) {
  Arguments arguments;
  begin(&arguments);
  arguments.flags = coherence;
  query(valid, scene, packet, &arguments);
}
template <auto coherence, auto query, typename Packet>
void ask(const int* valid, RTCScene scene, Packet* packet) {
  ask<coherence>(query, valid, scene, packet);
}

#endif

/// Rays of a packet that take much the same way, or do not.
template <auto coherence>
void intersect(const int* valid, RTCScene scene, RTCRayHit16* packet) {
  ask<coherence, rtcIntersect16>(valid, scene, packet);
}
template <auto coherence>
void occluded(const int* valid, RTCScene scene, RTCRay8* packet) {
  ask<coherence, rtcOccluded8>(valid, scene, packet);
}
template <auto coherence>
void occluded(const int* valid, RTCScene scene, RTCRay16* packet) {
  ask<coherence, rtcOccluded16>(valid, scene, packet);
}

}  // namespace sunlit::light
