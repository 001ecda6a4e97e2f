// SPDX-License-Identifier: Apache-2.0
// A display of a test's own, and a hand that types and clicks on it.
#pragma once

#include <string>

namespace penumbra::studio::viewer {

/// Xvfb, running from construction to destruction, with DISPLAY set to it.
class Display {
  public:
    /// `dpi` above 96 makes it a display on which everything must be drawn larger.
    explicit Display(int dpi = 96, const std::string& size = "1600x1200");
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;
    ~Display();

    /// DISPLAY is set to it again, after others.
    void use() const;

    /// Real events through the X server (XTEST); `script` is xdotool's, for instance "mousemove 10 20 click
    /// 1".
    static void input(const std::string& script);

  private:
    int process_ = 0;
    std::string name_;
};

}  // namespace penumbra::studio::viewer
