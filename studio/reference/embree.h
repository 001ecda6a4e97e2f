// SPDX-License-Identifier: Apache-2.0
// Embree 3 (Debian 12) or 4 (Debian 13), whichever was found; what differs between them stands here.
#pragma once

#if PENUMBRA_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace penumbra::studio {

/// What Embree hands on from a call to filters.
#if PENUMBRA_EMBREE_MAJOR >= 4
using RayContext = RTCRayQueryContext;
#else
using RayContext = RTCIntersectContext;
#endif

/// rtcOccluded16 for rays that go much the same way: tfar is -infinity where something blocks an active one.
/// The context is filled in.
inline void occludeCoherent(const int* active, RTCScene scene, RayContext& context, RTCRay16& rays) {
#if PENUMBRA_EMBREE_MAJOR >= 4
    rtcInitRayQueryContext(&context);
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    arguments.context = &context;
    rtcOccluded16(active, scene, &rays, &arguments);
#else
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded16(active, scene, &context, &rays);
#endif
}

}  // namespace penumbra::studio
