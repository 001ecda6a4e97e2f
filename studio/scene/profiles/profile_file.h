// SPDX-License-Identifier: Apache-2.0
// Files in which makers publish what their luminaires send: LM-63 (.ies) and EULUMDAT (.ldt). Strict in
// meaning, lenient in form. What they mean is in docs/lights.md.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "studio/scene/profiles/light_profile.h"

namespace penumbra::studio {

/// Limits of what is read: a tenth of a degree over the whole sphere has 1801 x 3601 angles.
inline constexpr std::uintmax_t maxProfile_bytes = 64u << 20;
inline constexpr int maxProfileAngles = 4096;
inline constexpr std::size_t maxProfileValues = 1u << 22;

/// Whether the name ends as that of a profile: .ies or .ldt, in any case.
bool isProfileName(const std::filesystem::path& file);

/// Reads a profile. Throws InputError "FILE:LINE: PROBLEM" for whatever is missing, contradicts itself or has
/// no meaning; what is merely odd is in LightProfile::warnings. `named` is where the file is named, for the
/// message that it is missing.
LightProfile readProfile(const std::filesystem::path& file, const std::string& named = "profile");

/// The text of another file that an LM-63 file names in its TILT line; throws InputError.
using TiltText = std::function<std::string(const std::string& name, int line)>;

/// LM-63 of 1986, 1991, 1995, 2002 and 2019; `fileName` is for messages.
LightProfile parseLm63(std::string_view text, const std::string& fileName, const TiltText& tiltText);

/// EULUMDAT (Stockmar 1990, as in the 1998 revision).
LightProfile parseEulumdat(std::string_view text, const std::string& fileName);

}  // namespace penumbra::studio
