// SPDX-License-Identifier: Apache-2.0
#include "studio/report/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <nlohmann/json.hpp>

#include "studio/image/atomic_file.h"
#include "studio/image/image_io.h"
#include "studio/image/label.h"
#include "studio/metrics/difference_image.h"
#include "studio/report/report_files.h"

namespace penumbra::studio {
namespace {

nlohmann::ordered_json spreadOf(const std::vector<double>& milliseconds) {
    if (milliseconds.empty()) return nullptr;
    const auto [low, high] = std::ranges::minmax(milliseconds);
    return {{"median", medianOf(milliseconds)}, {"min", low}, {"max", high}};
}

/// The numbers behind the pictures: channels V, truth and error (V - truth), or V.R, V.G ... for a textured
/// light.
void writeErrors(const std::filesystem::path& file, const Image& truth, const Image& visibility,
                 const Metadata& metadata) {
    Image error = visibility;
    for (std::size_t i = 0; i < error.values.size(); ++i) error.values[i] -= truth.values[i];
    ExrPicture picture{truth.width_px, truth.height_px, channelsOf(visibility, "V"), metadata};
    std::ranges::move(channelsOf(truth, "truth"), std::back_inserter(picture.channels));
    std::ranges::move(channelsOf(error, "error"), std::back_inserter(picture.channels));
    writeExr(file, picture);
}

std::string csvField(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

/// What was asked and promised of a light whose technique takes others, and what it truly was; empty for
/// others.
std::string promiseLine(const std::string& technique, const LightComparison& light) {
    if (light.chosen.empty()) return {};
    const auto count = [&](std::string_view name) {
        const auto found = std::ranges::find(light.counts, name, &std::pair<std::string, double>::first);
        return found == light.counts.end() ? std::optional<double>() : found->second;
    };
    std::string line = fmt::format("{}, {}: {}", technique, light.light, light.chosen);
    line +=
        fmt::format("; error asked {:g}, promised {:g}, truly {:.4f}", count("error asked for").value_or(0),
                    count("error promised").value_or(0), light.metrics.penumbra_rmse);
    if (const auto bound = count("mean error bound"))
        line += fmt::format(", bound of a pixel {:.3f}", *bound);
    if (const auto budget_ms = count("budget")) {
        line += fmt::format("; budget {:g} ms, spent {:.2f} ms", *budget_ms, count("spent").value_or(0));
        if (count("error gave way to the budget").value_or(0) > 0) line += ", the error gave way";
        if (count("budget gave way").value_or(0) > 0) line += ", the budget gave way";
    }
    return line + "\n";
}

/// Of those of whom it was asked for.
std::string flickerTable(const Comparison& comparison) {
    std::string table;
    for (const TechniqueComparison& technique : comparison.techniques) {
        for (const LightComparison& light : technique.lights) {
            if (!light.flicker) continue;
            if (table.empty())
                table =
                    fmt::format("{:<14} {:<14} {:>9} {:>9}\n", "technique", "light", "flicker", "popping");
            table += fmt::format("{:<14} {:<14} {:>9.4f} {:>8.2f}%\n", technique.technique, light.light,
                                 light.flicker->rms, 100 * light.flicker->popping);
        }
    }
    return table;
}

}  // namespace

std::string fileStem(const std::string& technique) {
    std::string stem = technique;
    std::ranges::replace_if(
        stem, [](unsigned char c) { return !std::isalnum(c) && c != '-' && c != '.'; }, '_');
    return stem;
}

std::string lightSuffix(const std::string& light, std::size_t lightCount) {
    return lightCount > 1 ? fileStem("." + light) : "";
}

std::string visibilityFile(const std::string& technique, const std::string& suffix) {
    return fileStem(technique) + ".visibility" + suffix + ".png";
}

std::string differenceFile(const std::string& technique, const std::string& suffix) {
    return fileStem(technique) + ".difference" + suffix + ".png";
}

double medianOf(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

nlohmann::ordered_json toJson(const Comparison& comparison) {
    nlohmann::ordered_json json = {{"scene", comparison.scene},
                                   {"size", {comparison.width_px, comparison.height_px}},
                                   {"renderer", comparison.renderer},
                                   {"clock", comparison.clock},
                                   {"reference",
                                    {{"samples", comparison.reference.samples},
                                     {"noise_rms", comparison.reference.noise_rms},
                                     {"rays_per_second", comparison.reference.raysPerSecond}}},
                                   {"results", nlohmann::json::array()}};
    for (const TechniqueComparison& technique : comparison.techniques) {
        for (const LightComparison& light : technique.lights) {
            const VisibilityMetrics& m = light.metrics;
            nlohmann::ordered_json counts = nlohmann::json::object();
            for (const auto& [name, value] : light.counts) counts[name] = value;
            nlohmann::ordered_json result = {{"technique", technique.technique},
                                             {"light", light.light},
                                             {"rmse", m.rmse},
                                             {"mae", m.mae},
                                             {"penumbra_rmse", m.penumbra_rmse},
                                             {"p99", m.p99},
                                             {"max", m.max},
                                             {"leak", m.leak},
                                             {"false_shadow", m.false_shadow},
                                             {"flip", technique.flip},
                                             {"ms", spreadOf(light.milliseconds)},
                                             {"counts", std::move(counts)}};
            if (!light.chosen.empty()) result["chosen"] = light.chosen;
            if (light.flicker) {
                result["flicker"] = light.flicker->rms;
                result["popping"] = light.flicker->popping;
            }
            json["results"].push_back(std::move(result));
        }
    }
    return json;
}

std::string toTable(const Comparison& comparison) {
    std::string table =
        fmt::format("{:<14} {:<14} {:>9} {:>9} {:>9} {:>7} {:>7} {:>8} {:>8} {:>9}\n", "technique", "light",
                    "rmse", "penumbra", "p99", "max", "leak", "false", "flip", "ms");
    for (const TechniqueComparison& technique : comparison.techniques) {
        for (const LightComparison& light : technique.lights) {
            const VisibilityMetrics& m = light.metrics;
            table += fmt::format(
                "{:<14} {:<14} {:>9.4f} {:>9.4f} {:>9.4f} {:>7.3f} {:>6.2f}% {:>7.2f}% {:>8.4f} {:>9.2f}\n",
                technique.technique, light.light, m.rmse, m.penumbra_rmse, m.p99, m.max, 100 * m.leak,
                100 * m.false_shadow, technique.flip, medianOf(light.milliseconds));
        }
    }
    table += flickerTable(comparison);
    for (const TechniqueComparison& technique : comparison.techniques) {
        for (const LightComparison& light : technique.lights)
            table += promiseLine(technique.technique, light);
    }
    table += fmt::format("reference: {} rays a pixel, noise {:.4f} rms, {:.2f} million rays/s\n",
                         comparison.reference.samples, comparison.reference.noise_rms,
                         1e-6 * comparison.reference.raysPerSecond);
    return table;
}

std::string toCsv(std::span<const Comparison> comparisons) {
    std::string csv =
        "scene,technique,light,rmse,mae,penumbra_rmse,p99,max,leak,false_shadow,flip,ms_median,flicker,"
        "popping\n";
    for (const Comparison& comparison : comparisons) {
        for (const TechniqueComparison& technique : comparison.techniques) {
            for (const LightComparison& light : technique.lights) {
                const VisibilityMetrics& m = light.metrics;
                csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},", csvField(comparison.scene),
                                   csvField(technique.technique), csvField(light.light), m.rmse, m.mae,
                                   m.penumbra_rmse, m.p99, m.max, m.leak, m.false_shadow, technique.flip,
                                   medianOf(light.milliseconds));
                csv += light.flicker ? fmt::format("{},{}\n", light.flicker->rms, light.flicker->popping)
                                     : std::string(",\n");
            }
        }
    }
    return csv;
}

void writeComparison(const std::filesystem::path& folder, const Comparison& comparison,
                     const Metadata& metadata) {
    const std::string reference(referenceName);
    std::vector<LabelledImage> sheet;
    const auto write = [&](const std::string& file, const Image& image) {
        writePng(folder / file, image, metadata);
    };

    write(reference + ".png", comparison.reference.display);
    // One row for each: the picture, then its visibility (the truth) or its errors, light by light.
    sheet.push_back({reference, comparison.reference.display});
    for (const Image& truth : comparison.reference.visibilities) sheet.push_back({"visibility", truth});
    for (const TechniqueComparison& technique : comparison.techniques) {
        write(fileStem(technique.technique) + ".png", technique.display);
        sheet.push_back({technique.technique, technique.display});
        for (std::size_t i = 0; i < technique.lights.size(); ++i) {
            const LightComparison& light = technique.lights[i];
            const Image& truth = comparison.reference.visibilities[i];
            const std::string suffix = lightSuffix(light.light, technique.lights.size());
            const Image difference = differenceImage(truth, light.visibility);
            write(visibilityFile(reference, suffix), truth);
            write(visibilityFile(technique.technique, suffix), light.visibility);
            write(differenceFile(technique.technique, suffix), difference);
            writeErrors(folder / (fileStem(technique.technique) + ".visibility" + suffix + ".exr"), truth,
                        light.visibility, metadata);
            sheet.push_back({technique.technique + suffix + " - truth, x5", difference});
        }
    }
    write("contact-sheet.png", contactSheet(sheet, 1 + int(comparison.reference.visibilities.size())));
    writeFileAtomically(folder / "report.html", toHtml(comparison));
}

}  // namespace penumbra::studio
