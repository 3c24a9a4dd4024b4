#include "tasks/trace.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>
#include <mutex>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tasks/task.hpp"

namespace aquagraph::tasks {

namespace {

// The events of one thread. Only that thread writes; others read once it is at rest.
struct Lane {
    Lane(std::thread::id owner_id, std::size_t capacity) : owner(owner_id), events(capacity) {}

    std::thread::id owner;
    std::vector<Trace::Event> events;
    std::atomic<std::size_t> count{0};
    std::atomic<std::size_t> dropped{0};
};

// Which lane this thread has used last, and of which trace: the number, not the address, which may be used again.
struct LaneInUse {
    std::uint64_t trace = 0;
    Lane* lane = nullptr;
};
constinit thread_local LaneInUse lane_in_use;

std::uint64_t next_trace_number() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

std::string json_text(std::string_view text) {
    return nlohmann::json(text).dump();
}

// Microseconds with the nanoseconds as decimals: exact, whatever the length of the run.
std::string microseconds(std::int64_t nanoseconds) {
    char text[32];
    std::snprintf(text, sizeof text, "%lld.%03d", static_cast<long long>(nanoseconds / 1000),
                  static_cast<int>(nanoseconds % 1000));
    return text;
}

}  // namespace

struct Trace::Implementation {
    explicit Implementation(Options chosen) : options(chosen), number(next_trace_number()), origin(now()) {
        lanes.push_back(std::make_unique<Lane>(std::this_thread::get_id(), options.events_per_thread));
    }

    Lane* lane_of_this_thread() {
        if (lane_in_use.trace == number) return lane_in_use.lane;
        const std::scoped_lock lock(mutex);
        const std::thread::id self = std::this_thread::get_id();
        auto known = std::find_if(lanes.begin(), lanes.end(), [&](const auto& lane) { return lane->owner == self; });
        if (known == lanes.end())
            known = lanes.insert(lanes.end(), std::make_unique<Lane>(self, options.events_per_thread));
        lane_in_use = {number, known->get()};
        return lane_in_use.lane;
    }

    Options options;
    std::uint64_t number;
    std::int64_t origin;
    mutable std::mutex mutex;  // guards what follows; a thread takes it for its first event only
    std::vector<std::unique_ptr<Lane>> lanes;
    std::vector<std::string> names;
    std::map<std::string, std::uint32_t, std::less<>> number_of_name;
    std::atomic<std::size_t> without_lane{0};
};

Trace::Trace() : Trace(Options{}) {}
Trace::Trace(Options options) : implementation_(std::make_unique<Implementation>(options)) {}
Trace::~Trace() = default;

std::int64_t Trace::now() noexcept {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

std::uint32_t Trace::name_of_events(std::string_view name) {
    const std::scoped_lock lock(implementation_->mutex);
    const auto known = implementation_->number_of_name.find(name);
    if (known != implementation_->number_of_name.end()) return known->second;
    const auto number = static_cast<std::uint32_t>(implementation_->names.size());
    implementation_->names.emplace_back(name);
    implementation_->number_of_name.emplace(name, number);
    return number;
}

bool Trace::records_blocks() const noexcept {
    return implementation_->options.blocks;
}

void Trace::record(const Event& event) noexcept {
    Lane* lane = nullptr;
    try {
        lane = implementation_->lane_of_this_thread();
    } catch (const std::bad_alloc&) {
        implementation_->without_lane.fetch_add(1, std::memory_order_relaxed);
        return;
    }
    const std::size_t index = lane->count.load(std::memory_order_relaxed);
    if (index == lane->events.size()) {
        lane->dropped.fetch_add(1, std::memory_order_relaxed);
        return;
    }
    lane->events[index] = event;
    lane->count.store(index + 1, std::memory_order_release);
}

std::size_t Trace::event_count() const {
    const std::scoped_lock lock(implementation_->mutex);
    std::size_t count = 0;
    for (const auto& lane : implementation_->lanes) count += lane->count.load(std::memory_order_acquire);
    return count;
}

std::size_t Trace::dropped_count() const {
    const std::scoped_lock lock(implementation_->mutex);
    std::size_t count = implementation_->without_lane.load();
    for (const auto& lane : implementation_->lanes) count += lane->dropped.load();
    return count;
}

void Trace::write(std::ostream& out) const {
    const std::size_t recorded = event_count();
    const std::size_t dropped = dropped_count();
    const std::scoped_lock lock(implementation_->mutex);

    nlohmann::json about = {{"program", "aquagraph"}, {"recorded_events", recorded}, {"dropped_events", dropped}};
    if (dropped > 0)
        about["note"] = "The buffer of a thread was full: " + std::to_string(dropped) +
                        " later events are missing. Each thread keeps " +
                        std::to_string(implementation_->options.events_per_thread) + " events.";
    out << "{\"displayTimeUnit\":\"ms\",\"otherData\":" << about.dump() << ",\"traceEvents\":[\n"
        << R"({"name":"process_name","ph":"M","pid":1,"tid":0,"args":{"name":"aquagraph"}})";
    std::vector<std::string> names;
    std::vector<std::string> families;
    for (const std::string& name : implementation_->names) {
        names.push_back(json_text(name));
        families.push_back(json_text(family_of(name)));
    }

    std::vector<Event> events;
    for (std::size_t number = 0; number < implementation_->lanes.size(); ++number) {
        const Lane& lane = *implementation_->lanes[number];
        const std::string thread = "\"pid\":1,\"tid\":" + std::to_string(number);
        out << ",\n{\"name\":\"thread_name\",\"ph\":\"M\"," << thread << ",\"args\":{\"name\":\""
            << (number == 0 ? "main" : "worker " + std::to_string(number)) << "\"}}";
        // A block is recorded before the task that contains it; viewers want the outer interval first.
        const std::size_t count = lane.count.load(std::memory_order_acquire);
        events.assign(lane.events.begin(), lane.events.begin() + static_cast<std::ptrdiff_t>(count));
        std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
            if (a.start != b.start) return a.start < b.start;
            if (a.end != b.end) return a.end > b.end;
            return a.block == whole_task && b.block != whole_task;
        });
        for (const Event& event : events) {
            out << ",\n{\"name\":" << names.at(event.name)
                << ",\"cat\":" << (event.block == whole_task ? families[event.name] : "\"block\"") << ",\"ph\":\"X\","
                << thread << ",\"ts\":" << microseconds(event.start - implementation_->origin)
                << ",\"dur\":" << microseconds(event.end - event.start) << ",\"args\":{\"run\":" << event.run;
            if (event.block != whole_task) out << ",\"block\":" << event.block;
            out << "}}";
        }
    }
    out << "\n]}\n";
}

void Trace::write(const std::string& path) const {
    std::ofstream file(path);
    if (!file) throw std::runtime_error("the trace file '" + path + "' cannot be opened for writing");
    write(file);
    file.close();
    if (!file) throw std::runtime_error("the trace file '" + path + "' could not be written to its end");
}

}  // namespace aquagraph::tasks
