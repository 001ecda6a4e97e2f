// SPDX-License-Identifier: Apache-2.0
#include "src/gl/program.h"

#include <algorithm>
#include <regex>

#include "penumbra/device.h"
#include "src/gl/buffer.h"
#include "src/gl/shader_library.h"

namespace penumbra::gl {
namespace {

void deleteShader(GLuint name) {
    glDeleteShader(name);
}

GLenum stageOf(std::string_view file) {
    if (file.ends_with(".vert.glsl")) return GL_VERTEX_SHADER;
    if (file.ends_with(".geom.glsl")) return GL_GEOMETRY_SHADER;
    if (file.ends_with(".frag.glsl")) return GL_FRAGMENT_SHADER;
    if (file.ends_with(".comp.glsl")) return GL_COMPUTE_SHADER;
    throw Error(Error::Kind::shader, "shader file '" + std::string(file) + "' does not name its stage");
}

/// Drivers write "0:14(5): error" (Mesa) or "0(14) : error" (NVIDIA); puts file and line for that.
std::string withFileNames(const std::string& log, const std::vector<std::string>& files) {
    static const std::regex place(R"((^|\n)(?:ERROR: )?\d+[:(](\d+)\)?)");
    std::string text;
    auto last = log.cbegin();
    for (std::sregex_iterator it(log.begin(), log.end(), place), end; it != end; ++it) {
        const std::size_t line = std::stoul((*it)[2]);
        const std::size_t file = std::min(line / ShaderLibrary::Source::linesPerFile, files.size() - 1);
        text.append(last, (*it)[0].first);
        text +=
            (*it)[1].str() + files[file] + ":" + std::to_string(line % ShaderLibrary::Source::linesPerFile);
        last = (*it)[0].second;
    }
    return text.append(last, log.cend());
}

std::string programLog(GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(std::size_t(length), '\0');
    glGetProgramInfoLog(program, length, nullptr, log.data());
    return log;
}

std::string shaderLog(GLuint shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(std::size_t(length), '\0');
    glGetShaderInfoLog(shader, length, nullptr, log.data());
    return log;
}

Handle<deleteShader> compile(const ShaderLibrary& library, const std::string& file,
                             const std::vector<std::string>& defines) {
    const ShaderLibrary::Source source = library.expand(file, defines);
    Handle<deleteShader> shader(glCreateShader(stageOf(file)));
    const char* text = source.text.c_str();
    glShaderSource(shader.name(), 1, &text, nullptr);
    glCompileShader(shader.name());
    GLint compiled = 0;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_FALSE) {
        throw Error(Error::Kind::shader,
                    file + " does not compile:\n" + withFileNames(shaderLog(shader.name()), source.files));
    }
    return shader;
}

}  // namespace

void ProgramState::build(const ShaderLibrary& library) {
    Handle<deleteProgram> program(glCreateProgram());
    for (const std::string& file : files) {
        glAttachShader(program.name(), compile(library, file, defines).name());
    }
    glLinkProgram(program.name());
    GLint linked = 0;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE) {
        throw Error(Error::Kind::shader, files.back() + " does not link:\n" + programLog(program.name()));
    }
    label(GL_PROGRAM, program.name(), files.back());
    handle = std::move(program);
}

Program::Program(ShaderLibrary& library, std::vector<std::string> files, std::vector<std::string> defines)
    : state_(std::make_shared<ProgramState>(ProgramState{std::move(files), std::move(defines), {}})) {
    state_->build(library);
    library.track(state_);
}

void dispatchPixels(int width_px, int height_px) {
    glDispatchCompute(GLuint(width_px + 7) / 8, GLuint(height_px + 7) / 8, 1);
}

void dispatchIndirect(const Buffer& buffer, std::size_t offset_bytes) {
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, buffer.name());
    glDispatchComputeIndirect(GLintptr(offset_bytes));
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

}  // namespace penumbra::gl
