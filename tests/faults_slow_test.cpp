// SPDX-License-Identifier: Apache-2.0
// One thing after the other fails, from the first to the last of a technique's first frame: room on the
// device, framebuffers, memory. Each time there is an error or a right result, the host's state is as before,
// and the next frame is right.
#include "tests/support/allocations.h"
#include "tests/support/gl_state.h"
#include "tests/support/host_test.h"

namespace penumbra::studio {
namespace {

/// Lets one of the calls fail that make room on the device, or ask whether it can be drawn to: the `n`-th,
/// from 1.
class DeviceFault {
  public:
    explicit DeviceFault(int n);
    DeviceFault(const DeviceFault&) = delete;
    DeviceFault& operator=(const DeviceFault&) = delete;
    ~DeviceFault();

    /// Whether so many calls were made.
    static bool happened() { return happened_; }

    static bool isDue() {
        if (--left_ != 0) return false;
        happened_ = true;
        return true;
    }
    /// To be answered once to whoever asks OpenGL for its error.
    static inline bool isOutOfMemory = false;

  private:
    static inline int left_ = 0;
    static inline bool happened_ = false;
};

/// A call that makes room. libepoxy calls through pointers that programs may exchange.
template <auto Slot>
struct MakesRoom;

template <typename... Arguments, void (**Slot)(Arguments...)>
struct MakesRoom<Slot> {
    static inline void (*original)(Arguments...) = nullptr;

    static void call(Arguments... arguments) {
        if (DeviceFault::isDue()) {
            DeviceFault::isOutOfMemory = true;
        } else {
            original(arguments...);
        }
    }
    static void install() { original = std::exchange(*Slot, call); }
    static void remove() { *Slot = original; }
};

PFNGLGETERRORPROC originalError = nullptr;
PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC originalStatus = nullptr;

GLenum errorOrFault() {
    return std::exchange(DeviceFault::isOutOfMemory, false) ? GLenum(GL_OUT_OF_MEMORY) : originalError();
}
GLenum statusOrFault(GLuint framebuffer, GLenum target) {
    return DeviceFault::isDue() ? GLenum(GL_FRAMEBUFFER_UNSUPPORTED) : originalStatus(framebuffer, target);
}

DeviceFault::DeviceFault(int n) {
    left_ = n;
    happened_ = isOutOfMemory = false;
    MakesRoom<&epoxy_glNamedBufferStorage>::install();
    MakesRoom<&epoxy_glTextureStorage2D>::install();
    MakesRoom<&epoxy_glTextureStorage3D>::install();
    originalError = std::exchange(epoxy_glGetError, errorOrFault);
    originalStatus = std::exchange(epoxy_glCheckNamedFramebufferStatus, statusOrFault);
}

DeviceFault::~DeviceFault() {
    MakesRoom<&epoxy_glNamedBufferStorage>::remove();
    MakesRoom<&epoxy_glTextureStorage2D>::remove();
    MakesRoom<&epoxy_glTextureStorage3D>::remove();
    epoxy_glGetError = originalError;
    epoxy_glCheckNamedFramebufferStatus = originalStatus;
}

class Faults : public HostTest, public ::testing::WithParamInterface<std::string> {
  protected:
    Image visibilityIn(const VisibilityBuffer& buffer) {
        return readTexture(buffer.texture(), buffer.width_px(), buffer.height_px(), 1);
    }

    /// A frame with the `n`-th thing failing, of meshes that no technique has seen: a technique's first, or
    /// one after it has drawn another scene. False when there are no more than n - 1. 0: nothing fails.
    template <typename Fault>
    bool failsWell(int n, bool isFirstFrame) {
        std::unique_ptr<Technique> technique;
        if (!isFirstFrame) {
            technique = workbench().makeTechnique(GetParam());
            const ShadowInputs before = drawScene("half-plane", {32, 24});
            VisibilityBuffer out(device(), before.view.width_px, before.view.height_px);
            technique->render(before, out);
        }
        const ShadowInputs inputs = drawScene({48, 36});
        VisibilityBuffer out(device(), inputs.view.width_px, inputs.view.height_px);
        const auto state = test::captureState();
        std::string message;
        bool happened = false;
        {
            const Fault fault(n);
            try {
                if (technique == nullptr) technique = workbench().makeTechnique(GetParam());
                technique->render(inputs, out);
            } catch (const Error& error) {
                EXPECT_EQ(error.kind(), Error::Kind::outOfMemory);
                message = error.what();
            } catch (const std::bad_alloc& error) {
                message = error.what();
            }
            happened = Fault::happened();
        }
        EXPECT_EQ(test::differences(state, test::captureState()), "") << "number " << n << ": " << message;
        if (n == 0) right_ = visibilityIn(out);
        if (message.empty()) {
            EXPECT_EQ(visibilityIn(out).values, right_.values) << "number " << n << " was swallowed";
        } else if (technique != nullptr) {
            technique->render(inputs, out);
            EXPECT_EQ(visibilityIn(out).values, right_.values)
                << "the frame after number " << n << ": " << message;
        }
        return n == 0 || happened;
    }

    template <typename Fault>
    void failOneAfterTheOther() {
        for (const bool isFirstFrame : {true, false}) {
            int n = 0;
            // Trees of casters take thousands of allocations, all alike: of those one in 13.
            while (failsWell<Fault>(n, isFirstFrame) && !HasFailure()) n += n < 200 ? 1 : 13;
            EXPECT_GT(n, isFirstFrame ? 5 : 0) << "a frame takes more";
        }
    }

  private:
    Image right_;
};

INSTANTIATE_TEST_SUITE_P(Catalog, Faults, everyTechnique(), techniqueTestName);

TEST_P(Faults, OfTheDevice) {
    failOneAfterTheOther<DeviceFault>();
}

TEST_P(Faults, OfMemory) {
    failOneAfterTheOther<test::AllocationFault>();
}

}  // namespace
}  // namespace penumbra::studio
