// SPDX-License-Identifier: Apache-2.0
#include "src/gl/program_interface.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>

namespace penumbra::gl {
namespace {

using Kind = ProgramResource::Kind;
using Statement = std::vector<std::string_view>;

bool isWordCharacter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Calls `visit` with the tokens of each statement, or of what stands before a brace; comments and the
/// preprocessor's lines are none.
template <typename Visit>
void forEachStatement(std::string_view text, Visit visit) {
    Statement statement;
    for (std::size_t i = 0; i < text.size();) {
        const char c = text[i];
        if (c == '#' || text.substr(i, 2) == "//") {
            i = std::min(text.find('\n', i), text.size());
        } else if (text.substr(i, 2) == "/*") {
            i = std::min(text.find("*/", i), text.size() - 2) + 2;
        } else if (isWordCharacter(c)) {
            const std::size_t start = i;
            while (i < text.size() && isWordCharacter(text[i])) ++i;
            statement.push_back(text.substr(start, i - start));
        } else {
            if (c == ';' || c == '{' || c == '}') {
                visit(statement);
                statement.clear();
            } else if (std::isspace(static_cast<unsigned char>(c)) == 0) {
                statement.push_back(text.substr(i, 1));
            }
            ++i;
        }
    }
}

/// Without the `layout(...)` at its start.
std::span<const std::string_view> withoutLayout(const Statement& statement) {
    std::span<const std::string_view> words(statement);
    if (words.empty() || words.front() != "layout") return words;
    const auto end = std::ranges::find(words, ")");
    return end == words.end() ? std::span<const std::string_view>{}
                              : words.subspan(std::size_t(end - words.begin()) + 1);
}

GLint componentsOf(std::string_view type) {
    return std::isdigit(static_cast<unsigned char>(type.back())) != 0 ? type.back() - '0' : 1;
}

/// Samplers and images of floats, or of integers.
bool isKindOf(std::string_view type, std::string_view kind) {
    return type.starts_with(kind) ||
           ((type.starts_with('i') || type.starts_with('u')) && type.substr(1).starts_with(kind));
}

/// What a statement declares; an empty name if nothing that is bound.
ProgramResource declaredBy(const Statement& statement, bool isVertexStage) {
    const auto words = withoutLayout(statement);
    const auto has = [&](std::string_view word) { return std::ranges::find(words, word) != words.end(); };
    const auto after = [&](std::string_view word, std::size_t steps) -> std::string_view {
        const auto place = std::size_t(std::ranges::find(words, word) - words.begin()) + steps;
        return place < words.size() ? words[place] : std::string_view();
    };
    ProgramResource resource;
    if (has("buffer")) {
        resource.kind = Kind::storageBlock;
        resource.name = after("buffer", 1);
        resource.isRead = !has("writeonly");
        resource.isWritten = !has("readonly");
    } else if (has("uniform")) {
        const auto type = std::ranges::find_if(words, [](std::string_view word) {
            return isKindOf(word, "sampler") || isKindOf(word, "image");
        });
        if (type != words.end()) {
            if (type + 1 == words.end()) return {};
            resource.kind = isKindOf(*type, "image") ? Kind::image : Kind::texture;
            resource.name = *(type + 1);
            resource.isRead = !has("writeonly");
            resource.isWritten = resource.kind == Kind::image && !has("readonly");
        } else if (words.back() == after("uniform", 1)) {
            resource.kind = Kind::uniformBlock;
            resource.name = words.back();
        }
    } else if (isVertexStage && !words.empty() && words.front() == "in" && words.size() == 3) {
        resource.kind = Kind::vertexInput;
        resource.name = words[2];
        resource.components = componentsOf(words[1]);
        resource.isInteger = words[1].starts_with('i') || words[1].starts_with('u');
    }
    return resource;
}

GLint property(GLuint program, GLenum interface, GLuint index, GLenum what) {
    GLint value = 0;
    glGetProgramResourceiv(program, interface, index, 1, &what, 1, nullptr, &value);
    return value;
}

/// Of the array without size that a storage block begins with; 0 if it begins with something else, or if what
/// is at its very start is not used.
GLuint elementSize(GLuint program, GLuint block) {
    const GLint count = property(program, GL_SHADER_STORAGE_BLOCK, block, GL_NUM_ACTIVE_VARIABLES);
    std::vector<GLint> variables(std::size_t(count), 0);
    const GLenum what = GL_ACTIVE_VARIABLES;
    glGetProgramResourceiv(program, GL_SHADER_STORAGE_BLOCK, block, 1, &what, count, nullptr,
                           variables.data());
    for (const GLint variable : variables) {
        const auto of = [&](GLenum property_) {
            return property(program, GL_BUFFER_VARIABLE, GLuint(variable), property_);
        };
        if (of(GL_OFFSET) != 0) continue;
        if (of(GL_TOP_LEVEL_ARRAY_SIZE) == 0) return GLuint(of(GL_TOP_LEVEL_ARRAY_STRIDE));
        return of(GL_ARRAY_SIZE) == 0 ? GLuint(of(GL_ARRAY_STRIDE)) : 0;
    }
    return 0;
}

/// Asks the program whether and where it has the resource; `nextUnit` has a counter for each kind.
void locate(GLuint program, ProgramResource& resource, std::array<GLuint, 5>& nextUnit) {
    GLuint& unit = nextUnit[std::size_t(resource.kind)];
    switch (resource.kind) {
        case Kind::uniformBlock:
        case Kind::storageBlock: {
            const bool isUniform = resource.kind == Kind::uniformBlock;
            const GLenum interface = isUniform ? GL_UNIFORM_BLOCK : GL_SHADER_STORAGE_BLOCK;
            const GLuint index = glGetProgramResourceIndex(program, interface, resource.name.c_str());
            if (index == GL_INVALID_INDEX) return;
            resource.isActive = true;
            resource.unit = unit++;
            if (isUniform) {
                glUniformBlockBinding(program, index, resource.unit);
                resource.size_bytes = GLuint(property(program, interface, index, GL_BUFFER_DATA_SIZE));
            } else {
                glShaderStorageBlockBinding(program, index, resource.unit);
                resource.size_bytes = elementSize(program, index);
            }
            return;
        }
        case Kind::texture:
        case Kind::image: {
            const GLint location = glGetUniformLocation(program, resource.name.c_str());
            if (location < 0) return;
            GLuint index = glGetProgramResourceIndex(program, GL_UNIFORM, resource.name.c_str());
            if (index == GL_INVALID_INDEX)
                index = glGetProgramResourceIndex(program, GL_UNIFORM, (resource.name + "[0]").c_str());
            resource.isActive = true;
            resource.count = GLuint(std::max(1, property(program, GL_UNIFORM, index, GL_ARRAY_SIZE)));
            resource.unit = unit;
            for (GLuint i = 0; i < resource.count; ++i)
                glProgramUniform1i(program, location + GLint(i), GLint(unit++));
            return;
        }
        case Kind::vertexInput: {
            const GLint location = glGetAttribLocation(program, resource.name.c_str());
            resource.isActive = location >= 0;
            resource.unit = GLuint(std::max(0, location));
            return;
        }
    }
}

GLuint mostOf(Kind kind) {
    switch (kind) {
        case Kind::uniformBlock:
            return uniformBlocks;
        case Kind::storageBlock:
            return storageBlocks;
        case Kind::image:
            return imageUnits;
        case Kind::texture:
        case Kind::vertexInput:
            break;
    }
    return textureUnits;  // and as many attributes
}

}  // namespace

ProgramInterface::ProgramInterface(GLuint program, std::span<const std::string> texts, int vertexStage) {
    for (std::size_t stage = 0; stage < texts.size(); ++stage) {
        forEachStatement(texts[stage], [&](const Statement& statement) {
            ProgramResource declared = declaredBy(statement, int(stage) == vertexStage);
            if (declared.name.empty()) return;
            const auto known = std::ranges::find(resources_, declared.name, &ProgramResource::name);
            if (known == resources_.end()) {
                resources_.push_back(std::move(declared));
            } else {
                known->isRead |= declared.isRead;
                known->isWritten |= declared.isWritten;
            }
        });
    }
    if (resources_.size() > 64) throw std::logic_error("a program with more than 64 resources");
    std::array<GLuint, 5> nextUnit{};
    for (std::size_t i = 0; i < resources_.size(); ++i) {
        locate(program, resources_[i], nextUnit);
        if (resources_[i].isActive) active_ |= std::uint64_t(1) << i;
    }
}

const ProgramResource* ProgramInterface::find(std::string_view name) const {
    const auto found = std::ranges::find(resources_, name, &ProgramResource::name);
    return found == resources_.end() ? nullptr : &*found;
}

const ProgramResource* ProgramInterface::firstBeyondPromise() const {
    const auto found = std::ranges::find_if(resources_, [](const ProgramResource& resource) {
        return resource.isActive && resource.unit + resource.count > mostOf(resource.kind);
    });
    return found == resources_.end() ? nullptr : &*found;
}

}  // namespace penumbra::gl
