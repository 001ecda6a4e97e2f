// SPDX-License-Identifier: Apache-2.0
#include "src/gl/program.h"

#include <algorithm>
#include <regex>
#include <stdexcept>

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

Handle<deleteShader> compile(const ShaderLibrary::Source& source, const std::string& file) {
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
    std::vector<std::string> texts;
    for (const std::string& file : files) {
        ShaderLibrary::Source source = library.expand(file, defines);
        glAttachShader(program.name(), compile(source, file).name());
        texts.push_back(std::move(source.text));
    }
    glLinkProgram(program.name());
    GLint linked = 0;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE) {
        throw Error(Error::Kind::shader, files.back() + " does not link:\n" + programLog(program.name()));
    }
    label(GL_PROGRAM, program.name(), files.back());
    handle = std::move(program);
    const auto vertexStage =
        std::ranges::find_if(files, [](const std::string& file) { return file.ends_with(".vert.glsl"); });
    interface = ProgramInterface(handle.name(), texts,
                                 vertexStage == files.end() ? -1 : int(vertexStage - files.begin()));
    if (const ProgramResource* const tooMuch = interface.firstBeyondPromise(); tooMuch != nullptr) {
        throw std::logic_error(files.back() + ": '" + tooMuch->name +
                               "' is one binding of its kind more than OpenGL 4.5 promises");
    }
    if (const ProgramResource* const block = interface.find("Constants");
        block != nullptr && block->isActive) {
        constants.reserve(block->size_bytes, "constants");
        lastConstants.clear();
    }
    if (vertexStage == files.end()) return;
    if (vertices.name() == 0) vertices = makeVertexArray();
    for (const ProgramResource& input : interface.all()) {
        if (input.kind != ProgramResource::Kind::vertexInput || !input.isActive) continue;
        if (input.isInteger) {
            glVertexArrayAttribIFormat(vertices.name(), input.unit, input.components, GL_INT, 0);
        } else {
            glVertexArrayAttribFormat(vertices.name(), input.unit, input.components, GL_FLOAT, GL_FALSE, 0);
        }
        glVertexArrayAttribBinding(vertices.name(), input.unit, input.unit);
    }
}

void ProgramState::writeConstants(std::span<const std::byte> bytes) {
    if (std::ranges::equal(bytes, lastConstants)) return;
    lastConstants.assign(bytes.begin(), bytes.end());
    constants.write(bytes);
}

Program::Program(ShaderLibrary& library, std::vector<std::string> files, std::vector<std::string> defines)
    : state_(library.program(std::move(files), std::move(defines))) {}

}  // namespace penumbra::gl
