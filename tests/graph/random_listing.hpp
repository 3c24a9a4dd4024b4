// Random listings for the tests of dependencies and order, and what they must obey, found the slow way.
#pragma once
#include <algorithm>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "tasks/task.hpp"

namespace aquagraph::tests {

inline std::vector<tasks::Task> random_listing(std::mt19937& random, std::size_t tasks, std::size_t resources) {
    const auto pick = [&](std::size_t below) {
        return std::uniform_int_distribution<std::size_t>(0, below - 1)(random);
    };
    const auto names = [&](std::size_t at_most) {
        std::vector<std::string> chosen;
        for (std::size_t count = pick(at_most + 1); count > 0; --count) {
            const std::size_t resource = pick(resources);
            const std::string family = resource % 2 == 0 ? "fluid" : "solid";
            // Now and then a whole family instead of one of its fields.
            chosen.push_back(pick(12) == 0 ? family : family + ".field" + std::to_string(resource));
        }
        return chosen;
    };
    std::vector<tasks::Task> listing;
    for (std::size_t task = 0; task < tasks; ++task)
        listing.push_back({.name = "task " + std::to_string(task), .reads = names(3), .writes = names(2)});
    return listing;
}

inline std::vector<std::string> parts(const std::string& resource) {
    std::vector<std::string> result;
    std::istringstream stream(resource);
    for (std::string part; std::getline(stream, part, '.');) result.push_back(part);
    return result;
}

inline bool any_overlap(const std::vector<std::string>& some, const std::vector<std::string>& others) {
    for (const std::string& a : some)
        for (const std::string& b : others) {
            const std::vector<std::string> left = parts(a);
            const std::vector<std::string> right = parts(b);
            bool same = true;
            for (std::size_t part = 0; part < std::min(left.size(), right.size()); ++part)
                same = same && left[part] == right[part];
            if (same) return true;
        }
    return false;
}

inline bool must_stay_in_order(const tasks::Task& earlier, const tasks::Task& later) {
    return any_overlap(earlier.writes, later.reads) || any_overlap(earlier.reads, later.writes) ||
           any_overlap(earlier.writes, later.writes);
}

}  // namespace aquagraph::tests
