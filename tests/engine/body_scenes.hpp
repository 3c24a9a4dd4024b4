// Scenes of bodies on their own: no water.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace aquagraph::test {

// A box from the origin; what holds and loads it is written behind.
struct ElasticBox {
    std::string corner, elements;  // opposite to the origin, and along each axis: "0.2, 0.1" and "4, 2"
    std::string end = "1.0";
    std::string gravity{};  // "0.0, -10.0"; without it none
    std::string solid{};    // more lines of [solid]
    std::string law = "linear", youngs_modulus = "1.0e7", poissons_ratio = "0.3";
    std::string scheme = "name = \"static\"\n";  // lines of [solid.scheme]
};

inline std::string elastic_box(const ElasticBox& box) {
    const bool in_space = std::count(box.corner.begin(), box.corner.end(), ',') == 2;
    const std::string zero = in_space ? "0.0, 0.0, 0.0" : "0.0, 0.0", one = in_space ? "1.0, 1.0, 1.0" : "1.0, 1.0";
    return fmt::format(R"(schema_version = 1
gravity = [{gravity}]
[time]
end = {end}
[domain]
min = [{zero}]
max = [{one}]
[solid]
{solid}[solid.box]
min = [{zero}]
max = [{corner}]
elements = [{elements}]
[solid.material]
law = "{law}"
density = 1000.0
youngs_modulus = {youngs_modulus}
poissons_ratio = {poissons_ratio}
[solid.scheme]
{scheme})",
                       fmt::arg("gravity", box.gravity.empty() ? zero : box.gravity), fmt::arg("end", box.end),
                       fmt::arg("zero", zero), fmt::arg("one", one), fmt::arg("solid", box.solid),
                       fmt::arg("corner", box.corner), fmt::arg("elements", box.elements), fmt::arg("law", box.law),
                       fmt::arg("youngs_modulus", box.youngs_modulus), fmt::arg("poissons_ratio", box.poissons_ratio),
                       fmt::arg("scheme", box.scheme));
}

// Three faces that slide in their own planes: a box at the origin that shrinks and stretches freely.
inline const std::string sliding_faces = R"([[solid.clamp]]
set = "left"
fixed = ["x"]
[[solid.clamp]]
set = "front"
fixed = ["y"]
[[solid.clamp]]
set = "bottom"
fixed = ["z"]
)";

// A cantilever in motion under its weight.
inline const std::string beam = R"(schema_version = 1
title = "Beam"
[time]
end = 0.01
[domain]
min = [0.0, 0.0]
max = [1.0, 1.0]
[solid]
name = "beam"
[solid.box]
min = [0.0, 0.0]
max = [1.0, 0.1]
elements = [10, 2]
[solid.material]
density = 1000.0
youngs_modulus = 1.0e7
poissons_ratio = 0.3
[solid.scheme]
step = 0.001
[[solid.clamp]]
set = "left"
)";

}  // namespace aquagraph::test
