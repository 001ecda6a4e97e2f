// SPDX-License-Identifier: Apache-2.0
#include "studio/report/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "studio/report/html.h"

namespace penumbra::studio {
namespace {

constexpr double width = 760, height = 460;
constexpr double left = 74, right = 170, top = 40, bottom = 56;

// Paul Tol's "muted" and "bright" colours: told apart by most colour-blind readers, and in grey by the
// markers.
constexpr std::array<const char*, 12> colors = {"#222222", "#88ccee", "#332288", "#ddcc77",
                                                "#cc6677", "#aa4499", "#882255", "#999933",
                                                "#117733", "#ee7733", "#44aa99", "#bbbbbb"};
constexpr int markerCount = 4;

struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    void include(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

/// From values to a span of pixels.
class Scale {
  public:
    Scale(const PlotAxis& axis, Range range, double pixelLow, double pixelHigh)
        : logarithmic_(axis.logarithmic), pixelLow_(pixelLow), pixelHigh_(pixelHigh) {
        if (!(range.low <= range.high)) range = {logarithmic_ ? 1.0 : 0.0, logarithmic_ ? 10.0 : 1.0};
        if (logarithmic_) {
            low_ = std::floor(2 * std::log10(range.low)) / 2;
            high_ = std::ceil(2 * std::log10(range.high)) / 2;
            if (high_ <= low_) high_ = low_ + 0.5;
        } else {
            low_ = std::min(range.low, 0.0);
            high_ = range.high > low_ ? range.high : low_ + 1;
        }
    }

    bool has(double value) const { return std::isfinite(value) && (!logarithmic_ || value > 0); }

    double pixel(double value) const {
        const double position = logarithmic_ ? std::log10(value) : value;
        return pixelLow_ + (pixelHigh_ - pixelLow_) * (position - low_) / (high_ - low_);
    }

    std::vector<double> ticks() const {
        std::vector<double> values;
        if (logarithmic_) {
            // 1, 2, 5 in each decade, or powers of ten where there are many decades.
            const bool fine = high_ - low_ <= 3;
            for (double decade = std::floor(low_); decade <= high_; ++decade) {
                for (const double digit : fine ? std::vector<double>{1, 2, 5} : std::vector<double>{1}) {
                    const double value = digit * std::pow(10, decade);
                    if (std::log10(value) >= low_ - 1e-9 && std::log10(value) <= high_ + 1e-9)
                        values.push_back(value);
                }
            }
            return values;
        }
        const double rough = (high_ - low_) / 5;
        const double decade = std::pow(10, std::floor(std::log10(rough)));
        const double digit = rough / decade < 2 ? 2 : rough / decade < 5 ? 5 : 10;
        for (double value = low_; value <= high_ * (1 + 1e-9); value += digit * decade)
            values.push_back(value);
        return values;
    }

  private:
    bool logarithmic_;
    double pixelLow_, pixelHigh_, low_ = 0, high_ = 1;
};

std::string number(double value) {
    if (value >= 1e6) return fmt::format("{:g} M", value * 1e-6);
    if (value >= 1e4) return fmt::format("{:g} k", value * 1e-3);
    return fmt::format("{:g}", value);
}

std::string marker(int kind, double x, double y, const char* color) {
    switch (kind % markerCount) {
        case 0:
            return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>", x, y, color);
        case 1:
            return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"7\" height=\"7\" fill=\"{}\"/>",
                               x - 3.5, y - 3.5, color);
        case 2:
            return fmt::format("<path d=\"M{:.1f} {:.1f}l4.5 8h-9z\" fill=\"{}\"/>", x, y - 5, color);
        default:
            return fmt::format("<path d=\"M{:.1f} {:.1f}l5 5l-5 5l-5-5z\" fill=\"{}\"/>", x, y - 5, color);
    }
}

std::string text(double x, double y, const char* attributes, std::string_view words) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, attributes,
                       html::escape(words));
}

std::string line(double x1, double y1, double x2, double y2, const char* attributes) {
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1, y1, x2, y2,
                       attributes);
}

class Drawing {
  public:
    explicit Drawing(const Plot& plot)
        : plot_(plot),
          x_(plot.x,
             range(
                 plot, [](const PlotPoint& p) { return std::array{p.x}; }, plot.x),
             left, width - right),
          y_(plot.y,
             range(
                 plot,
                 [](const PlotPoint& p) {
                     return std::array{p.y, p.low, p.high};
                 },
                 plot.y),
             height - bottom, top) {}

    std::string svg() const {
        std::string svg = fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
            "font-family=\"system-ui, sans-serif\" font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" "
            "fill=\"#fff\"/>\n",
            width, height);
        svg += text(left, 22, "font-size=\"15\" font-weight=\"600\"", plot_.title);
        svg += axes();
        svg += polyline(plot_.front, "stroke=\"#999\" stroke-dasharray=\"6 4\" stroke-width=\"2\"");
        int row = 0;
        for (std::size_t i = 0; i < plot_.series.size(); ++i) {
            if (!plot_.series[i].points.empty()) svg += seriesSvg(i, row++);
        }
        return svg + "</svg>\n";
    }

  private:
    template <typename Values>
    static Range range(const Plot& plot, Values values, const PlotAxis& axis) {
        Range all;
        for (const PlotSeries& series : plot.series) {
            for (const PlotPoint& point : series.points) {
                for (const double value : values(point)) {
                    if (std::isfinite(value) && (!axis.logarithmic || value > 0)) all.include(value);
                }
            }
        }
        return all;
    }

    std::string axes() const {
        std::string svg;
        for (const double value : x_.ticks()) {
            const double x = x_.pixel(value);
            svg += line(x, top, x, height - bottom, "stroke=\"#e4e4e4\"");
            svg += text(x, height - bottom + 17, "text-anchor=\"middle\"", number(value));
        }
        for (const double value : y_.ticks()) {
            const double y = y_.pixel(value);
            svg += line(left, y, width - right, y, "stroke=\"#e4e4e4\"");
            svg += text(left - 7, y + 4, "text-anchor=\"end\"", number(value));
        }
        svg += text((left + width - right) / 2, height - 14, "text-anchor=\"middle\"", plot_.x.title);
        const std::string turned = fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 18 {0})\"",
                                               (top + height - bottom) / 2);
        return svg + text(18, (top + height - bottom) / 2, turned.c_str(), plot_.y.title);
    }

    bool has(const PlotPoint& point) const { return x_.has(point.x) && y_.has(point.y); }

    std::string polyline(const std::vector<PlotPoint>& points, const std::string& attributes) const {
        std::string path;
        for (const PlotPoint& point : points) {
            if (has(point)) path += fmt::format("{:.1f},{:.1f} ", x_.pixel(point.x), y_.pixel(point.y));
        }
        return path.empty() ? ""
                            : fmt::format("<polyline points=\"{}\" fill=\"none\" {}/>\n", path, attributes);
    }

    std::string seriesSvg(std::size_t index, int legendRow) const {
        const PlotSeries& series = plot_.series[index];
        const char* const color = colors[index % colors.size()];
        std::string svg;
        if (plot_.joined)
            svg += polyline(series.points, fmt::format("stroke=\"{}\" stroke-width=\"1.5\"", color));
        for (const PlotPoint& point : series.points) {
            if (!has(point)) continue;
            const double x = x_.pixel(point.x);
            if (point.low < point.high && y_.has(point.low)) {
                svg += line(x, y_.pixel(point.low), x, y_.pixel(point.high),
                            fmt::format("stroke=\"{}\" stroke-opacity=\"0.5\"", color).c_str());
            }
            svg += marker(int(index), x, y_.pixel(point.y), color) + "\n";
            if (!point.label.empty())
                svg += text(x + 7, y_.pixel(point.y) - 5, "font-size=\"10\"", point.label);
        }
        const double y = top + 10 + 18.0 * legendRow;
        svg += marker(int(index), width - right + 16, y, color) + "\n";
        return svg + text(width - right + 28, y + 4, "", series.name);
    }

    const Plot& plot_;
    Scale x_, y_;
};

}  // namespace

std::string toSvg(const Plot& plot) {
    return Drawing(plot).svg();
}

}  // namespace penumbra::studio
