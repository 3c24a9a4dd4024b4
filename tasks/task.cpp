#include "tasks/task.hpp"

namespace aquagraph::tasks {

std::string_view family_of(std::string_view name) {
    return name.substr(0, name.find_first_of(" .:/([,"));
}

bool overlap(std::string_view resource, std::string_view other) {
    if (resource.size() > other.size()) return overlap(other, resource);
    if (!other.starts_with(resource)) return false;
    return resource.size() == other.size() || other[resource.size()] == '.';
}

}  // namespace aquagraph::tasks
