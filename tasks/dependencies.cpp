#include "tasks/dependencies.hpp"

#include <algorithm>
#include <cstdint>

namespace aquagraph::tasks {

namespace {

void add_hazards(HazardKind kind, const std::vector<std::string>& earlier, const std::vector<std::string>& later,
                 std::vector<Hazard>& hazards) {
    for (const std::string& first : earlier)
        for (const std::string& second : later) {
            if (!overlap(first, second)) continue;
            const std::string& narrower = first.size() > second.size() ? first : second;
            const bool known = std::any_of(hazards.begin(), hazards.end(),
                                           [&](const Hazard& hazard) { return hazard.resource == narrower; });
            if (!known) hazards.push_back({kind, narrower});
        }
}

// One bit per task of the listing.
class TaskSet {
  public:
    explicit TaskSet(std::size_t tasks) : words_((tasks + 63) / 64) {}
    bool contains(std::size_t task) const { return (words_[task / 64] >> (task % 64)) & 1U; }
    void insert(std::size_t task) { words_[task / 64] |= std::uint64_t{1} << (task % 64); }
    void insert(const TaskSet& other) {
        for (std::size_t word = 0; word < words_.size(); ++word) words_[word] |= other.words_[word];
    }

  private:
    std::vector<std::uint64_t> words_;
};

}  // namespace

std::vector<Hazard> hazards_between(const Task& earlier, const Task& later) {
    std::vector<Hazard> hazards;
    add_hazards(HazardKind::read_after_write, earlier.writes, later.reads, hazards);
    add_hazards(HazardKind::write_after_read, earlier.reads, later.writes, hazards);
    add_hazards(HazardKind::write_after_write, earlier.writes, later.writes, hazards);
    return hazards;
}

// For each task the earlier ones are visited from the nearest to the farthest. One that is already an ancestor needs
// no edge. One that is not and has a hazard does: a path to the task would have to pass through a task between the
// two, and that one has been visited and has brought its ancestors along. So what remains is the transitive reduction.
std::vector<Edge> derive_edges(std::span<const Task> listing) {
    std::vector<Edge> edges;
    std::vector<TaskSet> ancestors(listing.size(), TaskSet(listing.size()));
    for (std::size_t to = 0; to < listing.size(); ++to) {
        const std::size_t first_of_task = edges.size();
        for (std::size_t from = to; from-- > 0;) {
            if (ancestors[to].contains(from)) continue;
            std::vector<Hazard> hazards = hazards_between(listing[from], listing[to]);
            if (hazards.empty()) continue;
            ancestors[to].insert(from);
            ancestors[to].insert(ancestors[from]);
            edges.push_back({from, to, std::move(hazards)});
        }
        std::reverse(edges.begin() + static_cast<std::ptrdiff_t>(first_of_task), edges.end());
    }
    return edges;
}

const char* to_string(HazardKind kind) {
    switch (kind) {
        case HazardKind::read_after_write:
            return "read after write";
        case HazardKind::write_after_read:
            return "write after read";
        case HazardKind::write_after_write:
            return "write after write";
    }
    return "";
}

}  // namespace aquagraph::tasks
