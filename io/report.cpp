#include "io/report.hpp"

#include <fmt/format.h>

#include "io/atomic_file.hpp"
#include "io/report_assets.hpp"
#include "io/report_parts.hpp"

namespace aquagraph::io {
namespace {

// JSON inside <script>: nothing in it may end the script early.
std::string embedded(const nlohmann::json& data) {
    std::string text = data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    for (auto at = text.find('<'); at != std::string::npos; at = text.find('<', at)) text.replace(at, 1, "\\u003c");
    return text;
}

std::string seconds(double time) {
    return fmt::format("{:.4g} s", time);
}

// What the command line has changed: the title is the file's and does not know of it.
std::string changes(const Scene& scene) {
    if (scene.overrides.empty()) return {};
    return fmt::format("<br>changed: {}", html_escaped(fmt::format("{}", fmt::join(scene.overrides, ", "))));
}

std::string banner(const Scene& scene, const Report& report) {
    if (report.outcome == RunOutcome::finished) return {};
    const bool failed = report.outcome == RunOutcome::failed;
    return fmt::format(
        "<div class=\"banner {}\" role=\"alert\"><strong>{}</strong> It reached t = {} of {}. What follows is what "
        "there was up to then."
        "{}</div>\n",
        failed ? "failed" : "interrupted", failed ? "This run went wrong." : "This run was interrupted.",
        seconds(report.reached_time), seconds(scene.end_time),
        report.message.empty() ? "" : fmt::format("<pre>{}</pre>", html_escaped(report.message)));
}

std::string section(std::string_view title, const std::string& content) {
    return content.empty() ? "" : fmt::format("<section><h2>{}</h2>\n{}</section>\n", title, content);
}

std::string player_html(const nlohmann::json& flow) {
    if (flow.is_null()) return {};
    return R"(<figure id="player">
<canvas id="flow" tabindex="0" role="img" aria-label="The flow at one moment"></canvas>
<div class="controls">
<button id="play" type="button" aria-label="play">▶</button>
<input id="moment" type="range" min="0" value="0" step="1" aria-label="moment">
<output id="clock"></output>
<select id="field" aria-label="colour"></select>
<select id="side" aria-label="view" hidden><option value="25,20" selected>from a corner</option><option value="0,0">from the side</option><option value="90,0">from the end</option><option value="0,90">from above</option></select>
<select id="pace" aria-label="length of the film"><option value="5">5 s film</option><option value="10" selected>10 s film</option><option value="20">20 s film</option><option value="40">40 s film</option></select>
</div>
</figure>
)";
}

std::string folded(std::string_view title, const std::string& text) {
    return fmt::format("<details><summary>{}</summary><pre>{}</pre></details>\n", title, html_escaped(text));
}

std::string script(std::string_view code) {
    return fmt::format("<script>\n{}\n</script>\n", code);
}

}  // namespace

void write_report(const std::filesystem::path& file, const Scene& scene, const Report& report, const History& history,
                  const std::vector<Comparison>& comparisons, const FlowRecord& flow) {
    const nlohmann::json plot_data = plots(history, comparisons), flow_data = flow_player(scene, flow);
    bool compared = false, others = false;
    for (const nlohmann::json& plot : plot_data) (plot["compared"].get<bool>() ? compared : others) = true;

    std::string page =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta name=\"color-scheme\" "
        "content=\"light dark\">\n";
    page += fmt::format("<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n<main>\n", html_escaped(scene.title),
                        assets::style_css);
    page +=
        fmt::format("<header><h1>{}</h1><p class=\"sub\">{} · t = {} · computed by aquagraph{}</p></header>\n",
                    html_escaped(scene.title), html_escaped(scene.name), seconds(report.reached_time), changes(scene));
    page += banner(scene, report);
    page += key_number_cards(report, comparisons);
    page += section(scene.fluid ? "Flow" : "Motion", player_html(flow_data));
    page += section("Against the references", (compared ? "<div class=\"plots\" id=\"compared-plots\"></div>\n" : "") +
                                                  comparison_table(comparisons));
    page += section("History", others ? "<div class=\"plots\" id=\"other-plots\"></div>\n" : "");
    page += section("Where the time went", task_table(report));
    page += section("Parameters", parameter_tables(scene));
    page += section("Sources",
                    folded("scene file", scene.text) +
                        (report.summary.is_null()
                             ? ""
                             : folded("summary.json",
                                      report.summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace))));
    page += "</main>\n";
    page += fmt::format("<script type=\"application/json\" id=\"data\">{}</script>\n",
                        embedded({{"plots", plot_data}, {"flow", flow_data}}));
    page += script(assets::chart_js) + script(assets::plots_js) + script(assets::player_js);
    page += "</body>\n</html>\n";
    write_file_atomically(file, page);
}

}  // namespace aquagraph::io
