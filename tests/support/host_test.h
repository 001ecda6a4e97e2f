// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "studio/scene/builtin/builtin.h"
#include "tests/support/technique_test.h"

namespace penumbra::studio {

/// A context of its own for each test, so that what a host does to it hurts no other test.
class HostTest : public ::testing::Test {
  protected:
    HostTest() { workbench_.emplace(); }
    void TearDown() override {
        workbench_.reset();
        TechniqueTest::workbench().makeCurrent();
    }

    Workbench& workbench() { return *workbench_; }
    Device& device() { return workbench_->device(); }

    /// A scene's frame, ready for techniques.
    ShadowInputs drawScene(PictureSize size = {96, 72}) {
        moment_ = scene_.at(0);
        workbench_->open(scene_);
        const auto hard = workbench_->makeTechnique("hard");
        workbench_->run("hard", *hard, moment_, moment_.cameras.front(), size);
        return workbench_->frame().shadowInputs(moment_.lights.front());
    }

    const Scene scene_ = makeBuiltin("two-boxes");
    SceneMoment moment_;

  private:
    std::optional<Workbench> workbench_;
};

}  // namespace penumbra::studio
