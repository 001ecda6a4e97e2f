// SPDX-License-Identifier: Apache-2.0
#include "studio/report/html.h"

#include <fmt/format.h>

namespace penumbra::studio::html {
namespace {

constexpr const char* style = R"(
body { font: 15px/1.5 system-ui, sans-serif; margin: 2em auto; max-width: 1200px; padding: 0 1em; color: #222; background: #fafafa; }
h2 { margin-top: 2em; border-top: 1px solid #ccc; padding-top: .6em; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; margin: .8em 0; }
th, td { padding: .2em .8em; text-align: right; border-bottom: 1px solid #ddd; white-space: pre; }
th:first-child, td:first-child { text-align: left; white-space: normal; }
.row { display: grid; grid-template-columns: repeat(auto-fit, minmax(280px, 1fr)); gap: .6em; margin: .6em 0; }
.thirds { grid-template-columns: repeat(3, 1fr); }
.wipe { position: relative; width: 100%; user-select: none; }
.wipe img { width: 100%; display: block; }
.wipe img + img { position: absolute; inset: 0; clip-path: inset(0 0 0 var(--at, 50%)); }
.wipe::after { content: ""; position: absolute; top: 0; bottom: 0; left: var(--at, 50%); width: 1px; background: #fff; }
input[type=range] { width: 100%; }
figure { margin: 0; break-inside: avoid; } figure img { width: 100%; max-width: 590px; display: block; }
figcaption { font-size: 13px; color: #555; }
.judgement { background: #eef3f8; border-left: 4px solid #4477aa; padding: .4em .8em; }
.paper { color: #555; font-style: italic; }
.missing { color: #a33; }
@media print {
  input, select { display: none; }
  body { font-size: 10.5px; margin: 0; padding: 0; max-width: none; background: #fff; }
  h2 { margin-top: 1.2em; break-after: avoid; } tr, p { break-inside: avoid; }
  th, td { padding: .1em .5em; } figcaption { font-size: 10px; }
  .row { grid-template-columns: repeat(auto-fit, minmax(170px, 1fr)); } figure img { max-width: 300px; }
}
)";

}  // namespace

std::string escape(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        switch (c) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            default:
                escaped += c;
        }
    }
    return escaped;
}

std::string table(std::span<const std::string> header, std::span<const std::vector<std::string>> rows) {
    std::string html = "<table><tr>";
    for (const std::string& cell : header) html += "<th>" + escape(cell);
    html += "</tr>\n";
    for (const std::vector<std::string>& row : rows) {
        html += "<tr>";
        for (const std::string& cell : row) html += "<td>" + escape(cell);
        html += "</tr>\n";
    }
    return html + "</table>\n";
}

std::string page(std::string_view title, std::string_view body) {
    return fmt::format(
        "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>{0}</title><style>{1}</style>\n"
        "<h1>{0}</h1>\n{2}",
        escape(title), style, body);
}

}  // namespace penumbra::studio::html
