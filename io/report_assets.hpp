// The files of io/report_assets and Chart.js, compiled in by CMake.
#pragma once
#include <string_view>

namespace aquagraph::io::assets {

extern const std::string_view chart_js, style_css, plots_js, player_js;

}  // namespace aquagraph::io::assets
