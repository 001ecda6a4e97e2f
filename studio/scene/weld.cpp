// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/weld.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace penumbra::studio {
namespace {

// Cells this many distances wide: wide enough that most positions have one cell within reach, and narrow
// enough that no cell can hold more than some hundred positions which are that far apart.
constexpr double cellWidth = 8;

using Cell = glm::vec<3, std::int64_t>;

struct CellHash {
    std::size_t operator()(const Cell& cell) const {
        std::uint64_t hash = 0;
        for (int axis = 0; axis < 3; ++axis)
            hash = (hash ^ std::uint64_t(cell[axis])) * 0x9e3779b97f4a7c15u + (hash >> 29);
        return std::size_t(hash ^ hash >> 32);
    }
};

class Welder {
  public:
    explicit Welder(double distance_m) : distance_m_(distance_m) {}

    /// The first position that was within reach of this one, or the position itself.
    glm::vec3 kept(const glm::vec3& position) {
        const glm::dvec3 at = glm::dvec3(position) / (cellWidth * distance_m_);
        const Cell low(glm::floor(at - 1 / cellWidth)), high(glm::floor(at + 1 / cellWidth));
        for (std::int64_t x = low.x; x <= high.x; ++x)
            for (std::int64_t y = low.y; y <= high.y; ++y)
                for (std::int64_t z = low.z; z <= high.z; ++z)
                    if (const auto cell = cells_.find({x, y, z}); cell != cells_.end())
                        for (std::int32_t i = cell->second; i >= 0; i = next_[std::size_t(i)])
                            if (const glm::vec3& other = positions_[std::size_t(i)];
                                glm::distance(glm::dvec3(other), glm::dvec3(position)) <= distance_m_)
                                return other;
        const auto [cell, isNew] = cells_.try_emplace(Cell(glm::floor(at)), -1);
        next_.push_back(cell->second);
        cell->second = std::int32_t(positions_.size());
        positions_.push_back(position);
        return position;
    }

  private:
    double distance_m_;
    std::unordered_map<Cell, std::int32_t, CellHash> cells_;  ///< the last position in each
    std::vector<std::int32_t> next_;                          ///< the one before it in its cell; -1: none
    std::vector<glm::vec3> positions_;                        ///< that were kept
};

}  // namespace

void weld(std::span<const std::span<glm::vec3>> surfaces, float distance_m) {
    if (!(distance_m > 0)) return;
    Welder welder(distance_m);
    for (const std::span<glm::vec3>& surface : surfaces)
        for (glm::vec3& position : surface) position = welder.kept(position);
}

}  // namespace penumbra::studio
