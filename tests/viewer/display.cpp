// SPDX-License-Identifier: Apache-2.0
#include "tests/viewer/display.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

namespace penumbra::studio::viewer {

Display::Display(int dpi, const std::string& size) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
    process_ = fork();
    if (process_ == 0) {
        close(ends[0]);
        execlp("Xvfb", "Xvfb", "-displayfd", std::to_string(ends[1]).c_str(), "-screen", "0",
               (size + "x24").c_str(), "-nolisten", "tcp", "-ac", "-noreset", static_cast<char*>(nullptr));
        _exit(127);
    }
    close(ends[1]);
    std::string number;
    for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) number += c;
    close(ends[0]);
    if (number.empty()) throw std::runtime_error("Xvfb does not start; is the package xvfb installed?");
    name_ = ":" + number;
    use();
    // Where desktops say how large things must be.
    const std::string resource =
        "xprop -root -f RESOURCE_MANAGER 8s -set RESOURCE_MANAGER 'Xft.dpi:\t" + std::to_string(dpi) + "\n'";
    if (std::system(resource.c_str()) != 0) throw std::runtime_error("xprop failed");
}

Display::~Display() {
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
    unsetenv("DISPLAY");
}

void Display::use() const {
    setenv("DISPLAY", name_.c_str(), 1);
}

void Display::input(const std::string& script) {
    if (std::system(("xdotool " + script + " >/dev/null 2>&1").c_str()) != 0) {
        throw std::runtime_error("xdotool failed: " + script);
    }
}

}  // namespace penumbra::studio::viewer
