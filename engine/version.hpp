#pragma once

namespace aquagraph::engine {

inline constexpr const char* version = AQUAGRAPH_VERSION;

}  // namespace aquagraph::engine
