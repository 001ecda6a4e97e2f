// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "studio/report/comparison.h"
#include "studio/report/html.h"
#include "studio/report/report_files.h"

namespace penumbra::studio {
namespace {

using html::escape;

constexpr const char* script = R"(
const wipe = document.querySelector('.wipe'), images = wipe.querySelectorAll('img');
document.querySelector('input').oninput = e => wipe.style.setProperty('--at', e.target.value + '%');
document.querySelectorAll('select').forEach((s, i) => s.onchange = () => images[i].src = s.value);
)";

std::string figure(const std::string& file, const std::string& caption) {
    return fmt::format("<figure><img src=\"{0}\" alt=\"{1}\"><figcaption>{1}</figcaption></figure>\n", file,
                       escape(caption));
}

std::string metricsTable(const Comparison& comparison) {
    const std::vector<std::string> header = {"technique", "light", "RMSE",         "penumbra RMSE", "p99",
                                             "max",       "leak",  "false shadow", "FLIP",          "ms"};
    std::vector<std::vector<std::string>> rows;
    for (const TechniqueComparison& technique : comparison.techniques) {
        for (const LightComparison& light : technique.lights) {
            const VisibilityMetrics& m = light.metrics;
            rows.push_back({technique.technique, light.light, fmt::format("{:.4f}", m.rmse),
                            fmt::format("{:.4f}", m.penumbra_rmse), fmt::format("{:.4f}", m.p99),
                            fmt::format("{:.3f}", m.max), fmt::format("{:.2f} %", 100 * m.leak),
                            fmt::format("{:.2f} %", 100 * m.false_shadow),
                            fmt::format("{:.4f}", technique.flip),
                            fmt::format("{:.2f}", medianOf(light.milliseconds))});
        }
    }
    return html::table(header, rows);
}

std::string choices(const Comparison& comparison, std::string_view chosen) {
    std::string html;
    const auto add = [&](std::string_view name) {
        html += fmt::format("<option value=\"{}.png\"{}>{}</option>", fileStem(std::string(name)),
                            name == chosen ? " selected" : "", escape(std::string(name)));
    };
    add(referenceName);
    for (const TechniqueComparison& technique : comparison.techniques) add(technique.technique);
    return html;
}

}  // namespace

std::string toHtml(const Comparison& comparison) {
    const std::string first =
        comparison.techniques.empty() ? std::string(referenceName) : comparison.techniques.front().technique;
    std::string body = fmt::format(
        "<p>{} x {} pixels; reference: {} rays a pixel, noise {:.4f} rms. Times: {} on "
        "{}.<br><code>{}</code></p>\n",
        comparison.width_px, comparison.height_px, comparison.reference.samples,
        comparison.reference.noise_rms, escape(comparison.clock), escape(comparison.renderer),
        escape(comparison.command));
    body += metricsTable(comparison);
    body += fmt::format(
        "<h2>Wipe</h2>\n<p><select>{}</select> | <select>{}</select></p>\n<input type=\"range\" "
        "value=\"50\">\n"
        "<div class=\"wipe\"><img src=\"{}.png\" alt=\"left\"><img src=\"{}.png\" alt=\"right\"></div>\n",
        choices(comparison, first), choices(comparison, referenceName), fileStem(first), referenceName);
    const std::size_t lights = comparison.reference.visibilities.size();
    for (const TechniqueComparison& technique : comparison.techniques) {
        body += fmt::format("<h2>{}</h2>\n", escape(technique.technique));
        for (const LightComparison& light : technique.lights) {
            const std::string suffix = lightSuffix(light.light, lights);
            body += "<div class=\"row thirds\">" +
                    figure(visibilityFile(technique.technique, suffix), "visibility of " + light.light) +
                    figure(visibilityFile(std::string(referenceName), suffix), "truth") +
                    figure(differenceFile(technique.technique, suffix),
                           "difference x5 (red: too light, blue: too dark)") +
                    "</div>\n";
        }
    }
    body += fmt::format("<script>{}</script>\n", script);
    return html::page(comparison.scene + ": shadows compared", body);
}

}  // namespace penumbra::studio
