// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Marks what a shared library shows of itself; everything else is built hidden.
#if defined(__GNUC__)
#define PENUMBRA_API __attribute__((visibility("default")))
#else
#define PENUMBRA_API
#endif
