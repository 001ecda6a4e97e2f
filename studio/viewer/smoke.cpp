// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/smoke.h"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

namespace penumbra::studio::viewer {

void runSmoke(Viewer& viewer, int frames) {
    constexpr std::array ways = {Shown::picture, Shown::difference, Shown::error, Shown::visibility,
                                 Shown::illuminance};
    Session& session = viewer.session();
    const std::vector<std::string> names = techniqueChoices();
    for (int i = 0; i < frames; ++i) {
        Choices& choices = session.choices();
        choices.shown = ways[std::size_t(i) % ways.size()];
        choices.comparing = i % 3 == 1;
        if (const std::size_t lights = session.document().moment().lights.size(); lights > 0) {
            choices.light = std::size_t(i) % lights;
        }
        // Two frames each: the second one finds what the first has left.
        chooseTechnique(session, names[std::size_t(i / 2) % names.size()]);
        session.freeCamera().orbit(0.05f, 0);
        session.changedView();
        if (!viewer.frame(false)) return;
        if (!session.problem().empty()) {
            throw std::runtime_error(fmt::format("frame {}: {}", i, session.problem()));
        }
    }
    if (const int severe = session.device().severeMessageCount(); severe > 0) {
        throw std::runtime_error(fmt::format("the driver reported {} severe messages", severe));
    }
}

}  // namespace penumbra::studio::viewer
