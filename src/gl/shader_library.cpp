// SPDX-License-Identifier: Apache-2.0
#include "src/gl/shader_library.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "penumbra/device.h"
#include "src/gl/program.h"

namespace penumbra::gl {
namespace {

/// The path in `#include "path"`, or empty if `line` is no include.
std::string_view includedPath(std::string_view line) {
    constexpr std::string_view directive = "#include \"";
    if (!line.starts_with(directive)) return {};
    line.remove_prefix(directive.size());
    return line.substr(0, line.find('"'));
}

}  // namespace

void ShaderLibrary::add(std::span<const EmbeddedShader> shaders) {
    embedded_.insert(embedded_.end(), shaders.begin(), shaders.end());
}

std::string ShaderLibrary::read(std::string_view path) const {
    if (!sourceRoot_.empty()) {
        std::ifstream file(sourceRoot_ / path, std::ios::binary);
        if (file) {
            std::ostringstream text;
            text << file.rdbuf();
            return std::move(text).str();
        }
    } else if (const auto found = std::ranges::find(embedded_, path, &EmbeddedShader::path);
               found != embedded_.end()) {
        return std::string(found->text);
    }
    throw Error(Error::Kind::shader, "shader file '" + std::string(path) + "' not found");
}

ShaderLibrary::Source ShaderLibrary::expand(std::string_view path,
                                            std::span<const std::string> defines) const {
    Source source;
    expandInto(source, path, defines);
    return source;
}

void ShaderLibrary::expandInto(Source& source, std::string_view path,
                               std::span<const std::string> defines) const {
    if (std::ranges::find(source.files, path) != source.files.end()) return;
    const int firstLine = int(source.files.size()) * Source::linesPerFile;
    source.files.emplace_back(path);

    const auto continueAt = [&](int line) {
        source.text += "#line " + std::to_string(firstLine + line) + "\n";
    };
    std::istringstream lines(read(path));
    std::string line;
    if (firstLine > 0) continueAt(1);
    for (int number = 1; std::getline(lines, line); ++number) {
        if (const std::string_view included = includedPath(line); !included.empty()) {
            expandInto(source, included, {});
            continueAt(number + 1);
            continue;
        }
        source.text += line + "\n";
        if (line.starts_with("#version")) {
            for (const std::string& define : defines) source.text += "#define " + define + "\n";
            continueAt(number + 1);
        }
    }
}

void ShaderLibrary::track(const std::shared_ptr<ProgramState>& program) {
    std::erase_if(programs_, [](const auto& tracked) { return tracked.expired(); });
    programs_.push_back(program);
}

void ShaderLibrary::reload() {
    std::string failures;
    for (const auto& tracked : programs_) {
        const std::shared_ptr<ProgramState> program = tracked.lock();
        if (!program) continue;
        try {
            program->build(*this);
        } catch (const Error& error) {
            failures += error.what();
        }
    }
    if (!failures.empty()) throw Error(Error::Kind::shader, failures);
}

}  // namespace penumbra::gl
