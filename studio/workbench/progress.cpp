// SPDX-License-Identifier: Apache-2.0
#include "studio/workbench/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace penumbra::studio {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto intervalOnTerminal = std::chrono::milliseconds(100);
constexpr auto intervalElsewhere = std::chrono::seconds(10);

}  // namespace

Progress::Progress(std::string what)
    : what_(std::move(what)), terminal_(isatty(STDERR_FILENO) == 1), start_(Clock::now()), shown_(start_) {}

Progress::~Progress() {
    if (terminal_ && drawn_) fmt::print(stderr, "\r\x1b[K");
}

void Progress::update(double fraction, const std::string& stage) {
    const auto now = Clock::now();
    if (stage != stage_) {
        stage_ = stage;
        start_ = now;
    }
    if (now - shown_ < (terminal_ ? Clock::duration(intervalOnTerminal) : Clock::duration(intervalElsewhere)))
        return;
    shown_ = now;
    drawn_ = true;
    const double elapsed_s = std::chrono::duration<double>(now - start_).count();
    const double left_s = fraction > 0 ? elapsed_s * (1 - fraction) / fraction : 0;
    const std::string name = stage_.empty() ? what_ : what_ + ", " + stage_;
    if (terminal_) {
        constexpr int width = 30;
        const int filled = std::clamp(int(fraction * width), 0, width);
        fmt::print(stderr, "\r{} [{:#<{}}{:.<{}}] {:3.0f} %, {:.0f} s left \x1b[K", name, "", filled, "",
                   width - filled, 100 * fraction, left_s);
    } else {
        fmt::print(stderr, "{}: {:.0f} %, {:.0f} s left\n", name, 100 * fraction, left_s);
    }
    std::fflush(stderr);
}

}  // namespace penumbra::studio
