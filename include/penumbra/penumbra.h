// SPDX-License-Identifier: Apache-2.0
// Everything a host includes.
#pragma once

#if __cplusplus < 202002L
#error "Penumbra needs C++20: -std=c++20, or penumbra::penumbra of its CMake package, which says so"
#else
#include "penumbra/caster.h"
#include "penumbra/device.h"
#include "penumbra/diagnose.h"
#include "penumbra/framebuffer.h"
#include "penumbra/light.h"
#include "penumbra/math.h"
#include "penumbra/parameters.h"
#include "penumbra/points.h"
#include "penumbra/promise.h"
#include "penumbra/technique.h"
#include "penumbra/version.h"
#include "penumbra/view.h"
#endif
