// Whether a scene is two- or three-dimensional, and whether all its points agree about it.
#pragma once
#include "io/complaints.hpp"
#include "io/toml_document.hpp"

namespace aquagraph::io {

// The number of coordinates of domain.min (2 where it is not given); a complaint about every point with another number.
int agree_on_dimension(const CheckedDocument& document, Complaints& complaints);

}  // namespace aquagraph::io
