// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/gl/write_order.h"

namespace penumbra::gl {

struct ProgramState;

/// A shader file in the binary; `path` is relative to the repository's root.
struct EmbeddedShader {
    std::string_view path;
    std::string_view text;
};

/// Where programs get their source from, and how they get it anew.
class ShaderLibrary {
  public:
    /// `sourceRoot` empty: the embedded texts; else files beneath it.
    explicit ShaderLibrary(std::filesystem::path sourceRoot);

    /// Of all that is done with its programs.
    const std::shared_ptr<WriteOrder>& order() const { return order_; }

    /// Adds a target's files. Their storage must outlive the library (they are in the binary).
    void add(std::span<const EmbeddedShader> shaders);

    /// A file with all its `#include "path/from/root"` expanded once each. Its `#line` directives number the
    /// lines of files[i] from i * linesPerFile: the source-string number, which is meant for this, is 0 in
    /// Mesa's messages whatever one says.
    struct Source {
        static constexpr int linesPerFile = 100000;
        std::string text;
        std::vector<std::string> files;
    };
    /// `defines` are names, or "NAME value". Throws Error::Kind::shader if a file is missing.
    Source expand(std::string_view path, std::span<const std::string> defines) const;

    /// Compiles every program again. One that fails keeps its last good version; their messages are
    /// thrown together as Error::Kind::shader.
    void reload();

    /// The program of these files and defines, compiled when it is first asked for. Throws as Program does.
    std::shared_ptr<ProgramState> program(std::vector<std::string> files, std::vector<std::string> defines);

  private:
    std::string read(std::string_view path) const;
    void expandInto(Source& source, std::string_view path, std::span<const std::string> defines) const;

    std::filesystem::path sourceRoot_;
    std::vector<EmbeddedShader> embedded_;
    std::vector<std::shared_ptr<ProgramState>> programs_;
    std::shared_ptr<WriteOrder> order_ = std::make_shared<WriteOrder>();
};

}  // namespace penumbra::gl
