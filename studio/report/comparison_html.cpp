// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "studio/report/comparison.h"
#include "studio/report/html.h"
#include "studio/report/report_files.h"

namespace penumbra::studio {
namespace {

using html::escape;

constexpr const char* style = R"(
body { font: 15px/1.5 system-ui, sans-serif; margin: 2em auto; max-width: 1300px; padding: 0 1em; color: #222; background: #fafafa; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: .25em .8em; text-align: right; border-bottom: 1px solid #ddd; }
th:first-child, td:first-child, td:nth-child(2), th:nth-child(2) { text-align: left; }
.wipe { position: relative; width: 100%; max-width: 1300px; user-select: none; }
.wipe img { width: 100%; display: block; }
.wipe img + img { position: absolute; inset: 0; clip-path: inset(0 0 0 var(--at, 50%)); }
.wipe::after { content: ""; position: absolute; top: 0; bottom: 0; left: var(--at, 50%); width: 1px; background: #fff; }
input[type=range] { width: 100%; }
.row { display: grid; grid-template-columns: repeat(3, 1fr); gap: .6em; margin: .6em 0 1.6em; }
figure { margin: 0; } figure img { width: 100%; } figcaption { font-size: 13px; color: #555; }
@media print { input, select { display: none; } }
)";

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
    std::string html =
        "<table><tr><th>technique<th>light<th>RMSE<th>penumbra RMSE<th>p99<th>max<th>leak<th>false shadow"
        "<th>FLIP<th>ms</tr>\n";
    for (const TechniqueComparison& technique : comparison.techniques) {
        for (const LightComparison& light : technique.lights) {
            const VisibilityMetrics& m = light.metrics;
            html += fmt::format(
                "<tr><td>{}<td>{}<td>{:.4f}<td>{:.4f}<td>{:.4f}<td>{:.3f}<td>{:.2f} %<td>{:.2f} "
                "%<td>{:.4f}<td>{:.2f}"
                "</tr>\n",
                escape(technique.technique), escape(light.light), m.rmse, m.penumbra_rmse, m.p99, m.max,
                100 * m.leak, 100 * m.false_shadow, technique.flip, medianOf(light.milliseconds));
        }
    }
    return html + "</table>\n";
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
    std::string html = fmt::format(
        "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>{0}: shadows compared</title>"
        "<style>{1}</style>\n<h1>{0}</h1>\n<p>{2} x {3} pixels; reference: {4} rays a pixel, noise {5:.4f} "
        "rms. "
        "Times: {8} on {6}.<br><code>{7}</code></p>\n",
        escape(comparison.scene), style, comparison.width_px, comparison.height_px,
        comparison.reference.samples, comparison.reference.noise_rms, escape(comparison.renderer),
        escape(comparison.command), escape(comparison.clock));
    html += metricsTable(comparison);
    html += fmt::format(
        "<h2>Wipe</h2>\n<p><select>{}</select> | <select>{}</select></p>\n<input type=\"range\" "
        "value=\"50\">\n"
        "<div class=\"wipe\"><img src=\"{}.png\" alt=\"left\"><img src=\"{}.png\" alt=\"right\"></div>\n",
        choices(comparison, first), choices(comparison, referenceName), fileStem(first), referenceName);
    const std::size_t lights = comparison.reference.visibilities.size();
    for (const TechniqueComparison& technique : comparison.techniques) {
        html += fmt::format("<h2>{}</h2>\n", escape(technique.technique));
        for (const LightComparison& light : technique.lights) {
            const std::string suffix = lightSuffix(light.light, lights);
            html += "<div class=\"row\">" +
                    figure(visibilityFile(technique.technique, suffix), "visibility of " + light.light) +
                    figure(visibilityFile(std::string(referenceName), suffix), "truth") +
                    figure(differenceFile(technique.technique, suffix),
                           "difference x5 (red: too light, blue: too dark)") +
                    "</div>\n";
        }
    }
    return html + fmt::format("<script>{}</script>\n", script);
}

}  // namespace penumbra::studio
