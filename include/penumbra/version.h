// SPDX-License-Identifier: Apache-2.0
// Which Penumbra this is. The build reads it here, too; it stands nowhere else.
#pragma once

#include <string_view>

#include "penumbra/export.h"

#define PENUMBRA_VERSION_MAJOR 0
#define PENUMBRA_VERSION_MINOR 1
#define PENUMBRA_VERSION_PATCH 0

/// To compare with: `#if PENUMBRA_VERSION >= PENUMBRA_VERSION_OF(0, 2, 0)`
#define PENUMBRA_VERSION_OF(major, minor, patch) ((major)*1000000 + (minor)*1000 + (patch))
#define PENUMBRA_VERSION \
    PENUMBRA_VERSION_OF(PENUMBRA_VERSION_MAJOR, PENUMBRA_VERSION_MINOR, PENUMBRA_VERSION_PATCH)

namespace penumbra {

/// Of the library that is linked, which may be another than the headers' own where it is shared:
/// "0.1.0". Until 1.0 every minor version may change the interface. Valid for ever.
PENUMBRA_API std::string_view version();

}  // namespace penumbra
