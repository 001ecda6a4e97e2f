// SPDX-License-Identifier: Apache-2.0
#include "studio/measure/plan.h"

#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "studio/errors.h"
#include "studio/image/atomic_file.h"
#include "studio/image/image_io.h"
#include "studio/metrics/false_color.h"

namespace penumbra::studio {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Pen = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

// In pixels.
constexpr double longerSide = 900, leastSide = 160, border = 24, legendWidth = 110, titleHeight = 34,
                 noteHeight = 18, fontSize = 13, smallFont = 12;
constexpr int mostLevels = 9;
/// Of the grid's longer side, shown around it.
constexpr double marginShare = 0.06;

void fail(cairo_status_t status) {
    if (status == CAIRO_STATUS_SUCCESS) return;
    if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
    throw OutputError(fmt::format("the plan cannot be drawn: {}", cairo_status_to_string(status)));
}

/// Light enough for lines and numbers to be read on it.
std::array<double, 3> paleColor(double share) {
    constexpr double strength = 0.55;
    const std::array<float, 3> color = orderedColor(float(0.15 + 0.85 * share));
    return {1 - strength * (1 - double(color[0])), 1 - strength * (1 - double(color[1])),
            1 - strength * (1 - double(color[2]))};
}

struct Range {
    double min = 0, max = 1;
    double shareOf(double value) const { return max > min ? (value - min) / (max - min) : 0.5; }
};

Range rangeOf(const ValueGrid& grid) {
    Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const double value : grid.values) {
        if (!std::isfinite(value)) continue;
        range.min = std::min(range.min, value);
        range.max = std::max(range.max, value);
    }
    return range.min <= range.max ? range : Range{0, 0};
}

class PlanPainter {
  public:
    explicit PlanPainter(const Plan& plan) : plan_(plan), range_(rangeOf(plan.values)) {
        const GridFrame& frame = plan.frame;
        margin_m_ = marginShare * std::max(frame.width_m, frame.depth_m);
        const double width_m = frame.width_m + 2 * margin_m_, depth_m = frame.depth_m + 2 * margin_m_;
        scale_ = longerSide / std::max(width_m, depth_m);
        planSize_ = glm::dvec2(std::max(width_m * scale_, leastSide), std::max(depth_m * scale_, leastSide));
        levels_ = roundLevels(range_.min, range_.max, mostLevels);
    }

    glm::dvec2 size() const {
        return planSize_ + glm::dvec2(2 * border + legendWidth, 2 * border + titleHeight + 40 +
                                                                    noteHeight * double(plan_.notes.size()));
    }

    void paint(cairo_t* pen) {
        pen_ = pen;
        cairo_set_source_rgb(pen, 1, 1, 1);
        cairo_paint(pen);
        cairo_select_font_face(pen, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
        cairo_set_font_size(pen, fontSize + 2);
        text({border, border + fontSize}, plan_.title, 0);
        cairo_set_font_size(pen, smallFont);
        cairo_save(pen);
        cairo_rectangle(pen, border, border + titleHeight, planSize_.x, planSize_.y);
        cairo_clip(pen);
        paintCells();
        paintLines();
        paintIsolines();
        cairo_restore(pen);
        paintLegend();
        paintScale();
        cairo_set_font_size(pen, smallFont);
        double y = border + titleHeight + planSize_.y + 44 + noteHeight;
        for (const std::string& note : plan_.notes) {
            text({border, y}, note, 0);
            y += noteHeight;
        }
    }

  private:
    /// From metres in the grid's frame.
    glm::dvec2 at(const glm::dvec2& place_m) const {
        const double down_m = plan_.isAlongDown ? place_m.y : plan_.frame.depth_m - place_m.y;
        return glm::dvec2(border, border + titleHeight) +
               scale_ * (glm::dvec2(place_m.x, down_m) + margin_m_);
    }
    /// From columns and rows, whole ones in the middle of cells.
    glm::dvec2 atCell(const glm::dvec2& place) const {
        return at((place + 0.5) * glm::dvec2(plan_.frame.cellWidth_m(), plan_.frame.cellDepth_m()));
    }

    /// `anchor`: 0 begins, 0.5 is centred, 1 ends at the place.
    void text(const glm::dvec2& place, const std::string& words, double anchor) {
        cairo_text_extents_t extents;
        cairo_text_extents(pen_, words.c_str(), &extents);
        cairo_set_source_rgb(pen_, 0.1, 0.1, 0.1);
        cairo_move_to(pen_, place.x - anchor * extents.x_advance, place.y);
        cairo_show_text(pen_, words.c_str());
    }

    void paintCells() {
        const glm::dvec2 cell(plan_.frame.cellWidth_m(), plan_.frame.cellDepth_m());
        // Cells side by side leave no seam between them.
        cairo_set_antialias(pen_, CAIRO_ANTIALIAS_NONE);
        for (int row = 0; row < plan_.values.rows; ++row) {
            for (int column = 0; column < plan_.values.columns; ++column) {
                const double value = plan_.values.at(column, row);
                const glm::dvec2 a = at(glm::dvec2(column, row) * cell);
                const glm::dvec2 b = at(glm::dvec2(column + 1, row + 1) * cell);
                const std::array<double, 3> color =
                    std::isfinite(value) ? paleColor(range_.shareOf(value)) : std::array{0.82, 0.82, 0.82};
                cairo_set_source_rgb(pen_, color[0], color[1], color[2]);
                cairo_rectangle(pen_, std::min(a.x, b.x), std::min(a.y, b.y), std::abs(b.x - a.x),
                                std::abs(b.y - a.y));
                cairo_fill(pen_);
            }
        }
        cairo_set_antialias(pen_, CAIRO_ANTIALIAS_DEFAULT);
    }

    void paintLines() {
        const auto stroke = [&](const std::vector<PlanLines::Line>& lines, double width, double grey) {
            for (const PlanLines::Line& line : lines) {
                const glm::dvec2 a = at(line[0]), b = at(line[1]);
                cairo_move_to(pen_, a.x, a.y);
                cairo_line_to(pen_, b.x, b.y);
            }
            cairo_set_source_rgb(pen_, grey, grey, grey);
            cairo_set_line_width(pen_, width);
            cairo_set_line_cap(pen_, CAIRO_LINE_CAP_ROUND);
            cairo_stroke(pen_);
        };
        stroke(plan_.lines.seen, 0.8, 0.5);
        stroke(plan_.lines.cut, 2.2, 0.15);
        // The measured rectangle.
        const glm::dvec2 a = at({0, 0}), b = at({plan_.frame.width_m, plan_.frame.depth_m});
        constexpr std::array<double, 2> dashes = {6, 4};
        cairo_set_dash(pen_, dashes.data(), int(dashes.size()), 0);
        cairo_rectangle(pen_, std::min(a.x, b.x), std::min(a.y, b.y), std::abs(b.x - a.x),
                        std::abs(b.y - a.y));
        cairo_set_line_width(pen_, 0.8);
        cairo_stroke(pen_);
        cairo_set_dash(pen_, nullptr, 0, 0);
    }

    void paintIsolines() {
        struct Number {
            glm::dvec2 place;
            std::string words;
        };
        std::vector<Number> numbers;
        for (const double level : levels_) {
            for (const Isoline& line : isolinesOf(plan_.values, level)) {
                double length = 0;
                for (std::size_t i = 0; i < line.places.size(); ++i) {
                    const glm::dvec2 place = atCell(line.places[i]);
                    if (i == 0) {
                        cairo_move_to(pen_, place.x, place.y);
                    } else {
                        cairo_line_to(pen_, place.x, place.y);
                        length += glm::distance(place, atCell(line.places[i - 1]));
                    }
                }
                cairo_set_source_rgb(pen_, 0.05, 0.15, 0.45);
                cairo_set_line_width(pen_, 1.2);
                cairo_stroke(pen_);
                constexpr double leastForNumber = 60, betweenNumbers = 420;
                if (length < leastForNumber) continue;
                const int count = std::max(1, int(length / betweenNumbers));
                for (int i = 0; i < count; ++i)
                    numbers.push_back({along(line, length * (i + 0.5) / count), fmt::format("{:g}", level)});
            }
        }
        std::vector<glm::dvec2> taken;
        for (const auto& [place, words] : numbers) {
            constexpr double apart = 26;
            const auto isNear = [&](const glm::dvec2& other) { return glm::distance(place, other) < apart; };
            if (std::ranges::any_of(taken, isNear)) continue;
            taken.push_back(place);
            cairo_text_extents_t extents;
            cairo_text_extents(pen_, words.c_str(), &extents);
            cairo_set_source_rgba(pen_, 1, 1, 1, 0.85);
            cairo_rectangle(pen_, place.x - 0.5 * extents.x_advance - 2, place.y - 0.5 * smallFont - 1,
                            extents.x_advance + 4, smallFont + 2);
            cairo_fill(pen_);
            text(place + glm::dvec2(0, 0.36 * smallFont), words, 0.5);
        }
    }

    /// The place on the paper so far along the line.
    glm::dvec2 along(const Isoline& line, double length) const {
        for (std::size_t i = 1; i < line.places.size(); ++i) {
            const glm::dvec2 a = atCell(line.places[i - 1]), b = atCell(line.places[i]);
            const double step = glm::distance(a, b);
            if (length <= step) return glm::mix(a, b, step > 0 ? length / step : 0);
            length -= step;
        }
        return atCell(line.places.back());
    }

    void paintLegend() {
        constexpr int steps = 64;
        constexpr double width = 18;
        const double left = border + planSize_.x + 22, top = border + titleHeight;
        const double height = std::min(planSize_.y, 320.0) - 20;
        cairo_set_antialias(pen_, CAIRO_ANTIALIAS_NONE);
        for (int i = 0; i < steps; ++i) {
            const std::array<double, 3> color = paleColor(1 - (i + 0.5) / steps);
            cairo_set_source_rgb(pen_, color[0], color[1], color[2]);
            cairo_rectangle(pen_, left, top + 20 + height * i / steps, width, height / steps + 1);
            cairo_fill(pen_);
        }
        cairo_set_antialias(pen_, CAIRO_ANTIALIAS_DEFAULT);
        text({left, top + 10}, plan_.unit, 0);
        for (const double level : levels_) {
            const double y = top + 20 + height * (1 - range_.shareOf(level));
            text({left + width + 6, y + 0.36 * smallFont}, fmt::format("{:g}", level), 0);
        }
    }

    void paintScale() {
        const double wanted_m = 0.25 * planSize_.x / scale_;
        const double decade = std::pow(10.0, std::floor(std::log10(wanted_m)));
        const double digit = wanted_m / decade;
        const double length_m = decade * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
        const double y = border + titleHeight + planSize_.y + 20, length = length_m * scale_;
        for (int i = 0; i < 2; ++i) {
            cairo_rectangle(pen_, border + 0.5 * length * i, y, 0.5 * length, 6);
            cairo_set_source_rgb(pen_, i == 0 ? 0.1 : 1, i == 0 ? 0.1 : 1, i == 0 ? 0.1 : 1);
            cairo_fill_preserve(pen_);
            cairo_set_source_rgb(pen_, 0.1, 0.1, 0.1);
            cairo_set_line_width(pen_, 1);
            cairo_stroke(pen_);
        }
        text({border + length + 8, y + 8}, fmt::format("{:g} m", length_m), 0);
    }

    const Plan& plan_;
    Range range_;
    double margin_m_ = 0, scale_ = 1;
    glm::dvec2 planSize_{0};
    std::vector<double> levels_;
    cairo_t* pen_ = nullptr;
};

void paintOn(const Surface& surface, PlanPainter& painter) {
    fail(cairo_surface_status(surface.get()));
    const Pen pen(cairo_create(surface.get()), cairo_destroy);
    painter.paint(pen.get());
    fail(cairo_status(pen.get()));
}

Image imageOf(PlanPainter& painter) {
    const glm::ivec2 size(glm::ceil(painter.size()));
    const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, size.x, size.y),
                          cairo_surface_destroy);
    paintOn(surface, painter);
    cairo_surface_flush(surface.get());
    Image image(size.x, size.y, 3);
    const unsigned char* data = cairo_image_surface_get_data(surface.get());
    const std::size_t stride = std::size_t(cairo_image_surface_get_stride(surface.get()));
    for (int y = 0; y < size.y; ++y) {
        const auto* row = reinterpret_cast<const std::uint32_t*>(data + std::size_t(y) * stride);
        for (int x = 0; x < size.x; ++x) {
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = float(row[x] >> (16 - 8 * c) & 255u) / 255;
        }
    }
    return image;
}

std::string svgOf(PlanPainter& painter) {
    std::string svg;
    const auto append = [](void* text, const unsigned char* data, unsigned length) {
        static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
        return CAIRO_STATUS_SUCCESS;
    };
    const Surface surface(
        cairo_svg_surface_create_for_stream(append, &svg, painter.size().x, painter.size().y),
        cairo_surface_destroy);
    paintOn(surface, painter);
    cairo_surface_finish(surface.get());
    fail(cairo_surface_status(surface.get()));
    return svg;
}

}  // namespace

void requirePlanName(const std::filesystem::path& file) {
    if (file.extension() == ".png" || file.extension() == ".svg") return;
    throw UsageError(fmt::format("-o '{}': plans are .png or .svg", file.string()));
}

void writePlan(const std::filesystem::path& file, const Plan& plan, const Metadata& metadata) {
    requirePlanName(file);
    PlanPainter painter(plan);
    if (file.extension() == ".png") {
        writePng(file, imageOf(painter), metadata);
    } else {
        writeFileAtomically(file, svgOf(painter));
    }
}

}  // namespace penumbra::studio
