// Keys, reading and checking of a quantity over time (io/scene_time_law_data.hpp).
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/complaints.hpp"
#include "io/scene_keys.hpp"
#include "io/scene_time_law_data.hpp"
#include "io/toml_document.hpp"
#include "physics/time_law.hpp"

namespace aquagraph::io {

// Its keys in a section. unit: of the quantity; rate_unit: of its rate.
std::vector<SceneKey> time_law_keys(std::string_view section, std::string_view unit, std::string_view rate_unit);

// at: "solid.motion[0]"
void read_time_law(const CheckedDocument& document, const std::string& at, const std::filesystem::path& folder,
                   TimeLawScene& law);
// Complains where nothing is given, where two ways of the same are, and where a table cannot be used.
void validate_time_law(const TimeLawScene& law, const std::string& at, Complaints& complaints);

// Throws std::exception for a table that cannot be used.
TimeFunction time_function(const TimeLawScene& law);

}  // namespace aquagraph::io
