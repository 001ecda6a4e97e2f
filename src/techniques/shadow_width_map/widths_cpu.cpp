// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/shadow_width_map/widths_cpu.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace penumbra::shadow_width_map {
namespace {

struct Offset {
    int x, y;
};
constexpr std::array<Offset, 4> directions = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

struct Line {
    double x = 0, y = 0;
    double normalX = 0, normalY = 0;
};

/// The sides of blocked texels towards those that are not, and lines through them.
class Sides {
  public:
    Sides(std::span<const bool> blocked, int size_px) : size_px_(size_px), sides_(blocked.size()) {
        for (int y = 0; y < size_px; ++y) {
            for (int x = 0; x < size_px; ++x) {
                for (unsigned i = 0; i < 4; ++i) {
                    const int x2 = std::clamp(x + directions[i].x, 0, size_px - 1);
                    const int y2 = std::clamp(y + directions[i].y, 0, size_px - 1);
                    if (blocked[index(x, y)] && !blocked[index(x2, y2)]) sides_[index(x, y)] |= 1u << i;
                }
            }
        }
    }

    unsigned of(int x, int y) const {
        return std::min(x, y) < 0 || std::max(x, y) >= size_px_ ? 0 : sides_[index(x, y)];
    }

    /// Through the middles of all sides at most far_px texels away and fromLine_px from `near` that do not
    /// look the other way; `near` where they cancel.
    Line fit(int x, int y, int far_px, const Line& near, double fromLine_px) const {
        const Offset look = lookOf(of(x, y));
        Line sum;
        int count = 0;
        for (int y2 = y - far_px; y2 <= y + far_px; ++y2) {
            for (int x2 = x - far_px; x2 <= x + far_px; ++x2) {
                for (unsigned i = 0; i < 4; ++i) {
                    const Offset& direction = directions[i];
                    const double middleX = x2 + 0.5 + 0.5 * direction.x;
                    const double middleY = y2 + 0.5 + 0.5 * direction.y;
                    const double off = (middleX - near.x) * near.normalX + (middleY - near.y) * near.normalY;
                    if ((of(x2, y2) >> i & 1) == 0 || look.x * direction.x + look.y * direction.y < 0 ||
                        std::abs(off) > fromLine_px) {
                        continue;
                    }
                    sum.x += middleX;
                    sum.y += middleY;
                    sum.normalX += direction.x;
                    sum.normalY += direction.y;
                    ++count;
                }
            }
        }
        const double length = std::hypot(sum.normalX, sum.normalY);
        if (length == 0) return near;
        return {sum.x / count, sum.y / count, sum.normalX / length, sum.normalY / length};
    }

  private:
    std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(size_px_) + std::size_t(x); }

    /// Where the sides look to; where they cancel, where the first does.
    static Offset lookOf(unsigned sides) {
        Offset sum{0, 0}, first{0, 0};
        for (unsigned i = 4; i-- > 0;) {
            if ((sides >> i & 1) == 0) continue;
            first = directions[i];
            sum = {sum.x + first.x, sum.y + first.y};
        }
        return sum.x == 0 && sum.y == 0 ? first : sum;
    }

    int size_px_;
    std::vector<unsigned> sides_;
};

/// As a signed byte keeps a number of this range.
double packed(double value, double range) {
    return std::round(std::clamp(value / range, -1.0, 1.0) * 127) / 127 * range;
}

}  // namespace

std::vector<float> sweepShadowWidths(std::span<const bool> blocked, int size_px, float difference) {
    const auto size = std::size_t(size_px);
    std::vector<float> widths(blocked.begin(), blocked.end());
    const auto sweep = [&](std::size_t from, std::size_t to) {
        widths[to] = std::min(widths[to], widths[from] + difference);
    };
    for (std::size_t y = 0; y < size; ++y) {
        for (std::size_t x = 1; x < size; ++x) sweep(y * size + x - 1, y * size + x);
        for (std::size_t x = size - 1; x > 0; --x) sweep(y * size + x, y * size + x - 1);
    }
    for (std::size_t y = 1; y < size; ++y) {
        for (std::size_t x = 0; x < size; ++x) sweep((y - 1) * size + x, y * size + x);
    }
    for (std::size_t y = size - 1; y > 0; --y) {
        for (std::size_t x = 0; x < size; ++x) sweep(y * size + x, (y - 1) * size + x);
    }
    return widths;
}

std::vector<SilhouettePiece> silhouettePieces(std::span<const bool> blocked, int size_px, int cell_px) {
    const Sides sides(blocked, size_px);
    const int cells = (size_px + cell_px - 1) / cell_px;
    std::vector<SilhouettePiece> pieces;
    for (int cell = 0; cell < cells * cells; ++cell) {
        const int left = cell % cells * cell_px, top = cell / cells * cell_px;
        int nearest = std::numeric_limits<int>::max(), x = 0, y = 0;
        for (int i = 0; i < cell_px * cell_px; ++i) {
            const int dx = 2 * (i % cell_px) + 1 - cell_px, dy = 2 * (i / cell_px) + 1 - cell_px;
            const int square = dx * dx + dy * dy;
            if (square >= nearest || sides.of(left + i % cell_px, top + i / cell_px) == 0) continue;
            nearest = square;
            x = left + i % cell_px;
            y = top + i / cell_px;
        }
        if (nearest == std::numeric_limits<int>::max()) continue;
        Line line = sides.fit(x, y, 1, {}, 0);
        line = sides.fit(x, y, cell_px == 1 ? 1 : std::min(cell_px + 1, 4), line, 1);
        // Along the line, the piece is where its texel is.
        const double along = (x + 0.5 - line.x) * -line.normalY + (y + 0.5 - line.y) * line.normalX;
        const double middleX = x + 0.5 + packed(line.x - along * line.normalY - x - 0.5, 8);
        const double middleY = y + 0.5 + packed(line.y + along * line.normalX - y - 0.5, 8);
        const double border = 0.01 * cell_px;
        pieces.push_back({middleX, middleY, packed(line.normalX, 1), packed(line.normalY, 1),
                          std::clamp(middleX, left + border, left + cell_px - border),
                          std::clamp(middleY, top + border, top + cell_px - border)});
    }
    return pieces;
}

std::vector<float> exactShadowWidths(std::span<const bool> blocked, int size_px, int cell_px) {
    const auto cells = std::size_t((size_px + cell_px - 1) / cell_px);
    std::vector<std::vector<SilhouettePiece>> columns(cells);
    for (const SilhouettePiece& piece : silhouettePieces(blocked, size_px, cell_px))
        columns[std::size_t(piece.siteX_px) / std::size_t(cell_px)].push_back(piece);

    std::vector<float> widths(cells * cells, std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < widths.size(); ++i) {
        const std::size_t row = i / cells;
        const double x = (double(i - row * cells) + 0.5) * cell_px, y = (double(row) + 0.5) * cell_px;
        double nearest = std::numeric_limits<double>::infinity();
        for (const std::vector<SilhouettePiece>& column : columns) {
            if (column.empty()) continue;
            const SilhouettePiece& piece = *std::ranges::min_element(
                column, {}, [&](const SilhouettePiece& p) { return std::abs(p.siteY_px - y); });
            const double toSite = std::hypot(piece.siteX_px - x, piece.siteY_px - y);
            if (toSite >= nearest) continue;
            nearest = toSite;
            const double dx = x - piece.middleX_px, dy = y - piece.middleY_px;
            const double along =
                std::clamp(dy * piece.normalX - dx * piece.normalY, -0.75 * cell_px, 0.75 * cell_px);
            widths[i] = float(std::hypot(dx + along * piece.normalY, dy - along * piece.normalX));
        }
    }
    return widths;
}

}  // namespace penumbra::shadow_width_map
