// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/shadow_width_map/widths_cpu.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Squared distances along one line, from squared heights.
class LineTransform {
  public:
    explicit LineTransform(int size)
        : heights_(std::size_t(size)), sites_(std::size_t(size)), begins_(std::size_t(size)) {}

    void apply(std::vector<double>& values, std::size_t first, std::size_t stride) {
        const std::size_t size = heights_.size();
        for (std::size_t i = 0; i < size; ++i) heights_[i] = values[first + i * stride];
        int top = -1;
        for (std::size_t i = 0; i < size; ++i) {
            if (heights_[i] == infinity) continue;
            double begin = -infinity;
            for (; top >= 0; --top) {
                const std::size_t site = sites_[std::size_t(top)];
                begin = (heights_[i] + double(i * i) - heights_[site] - double(site * site)) /
                        (2.0 * double(i - site));
                if (begin > begins_[std::size_t(top)]) break;
                begin = -infinity;
            }
            ++top;
            sites_[std::size_t(top)] = i;
            begins_[std::size_t(top)] = begin;
        }
        if (top < 0) return;
        for (std::size_t i = size; i-- > 0;) {
            while (begins_[std::size_t(top)] > double(i)) --top;
            const std::size_t site = sites_[std::size_t(top)];
            const double across = double(i) - double(site);
            values[first + i * stride] = across * across + heights_[site];
        }
    }

  private:
    std::vector<double> heights_;
    std::vector<std::size_t> sites_;
    std::vector<double> begins_;
};

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

std::vector<float> exactShadowWidths(std::span<const bool> blocked, int size_px, int cell_px) {
    const auto size = std::size_t(size_px), cell = std::size_t(cell_px);
    const std::size_t cells = (size + cell - 1) / cell;
    // On a grid of half texels, a texel's centre is at odd places, and the middles of its sides beside that.
    const std::size_t halves = 2 * cells * cell + 1;
    std::vector<double> squares(halves * halves, infinity);
    for (std::size_t y = 0; y < size; ++y) {
        for (std::size_t x = 0; x < size; ++x) {
            const bool own = blocked[y * size + x];
            if (x + 1 < size && blocked[y * size + x + 1] != own)
                squares[(2 * y + 1) * halves + 2 * x + 2] = 0;
            if (y + 1 < size && blocked[(y + 1) * size + x] != own)
                squares[(2 * y + 2) * halves + 2 * x + 1] = 0;
        }
    }
    const int length = int(halves);
    LineTransform line(length);
    const auto middleOf = [&](std::size_t index) { return cell * (2 * index + 1); };
    for (std::size_t x = 0; x < halves; ++x) line.apply(squares, x, halves);
    for (std::size_t row = 0; row < cells; ++row) line.apply(squares, middleOf(row) * halves, 1);
    std::vector<float> widths(cells * cells);
    for (std::size_t i = 0; i < widths.size(); ++i) {
        widths[i] = float(0.5 * std::sqrt(squares[middleOf(i / cells) * halves + middleOf(i % cells)]));
    }
    return widths;
}

}  // namespace penumbra
