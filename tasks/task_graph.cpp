#include "tasks/task_graph.hpp"

#include <oneapi/tbb/flow_graph.h>

#include <deque>
#include <stdexcept>
#include <utility>

#include "tasks/measurement.hpp"

namespace aquagraph::tasks {

namespace {

// The message of an exception and of those it was made from, outermost first. A TaskError already contains both.
std::string message_of(const std::exception& error) {
    if (dynamic_cast<const TaskError*>(&error) != nullptr) return error.what();
    try {
        std::rethrow_if_nested(error);
    } catch (const std::exception& cause) {
        return error.what() + (": " + message_of(cause));
    } catch (...) {
    }
    return error.what();
}

std::string label(const Task& task) {
    return task.group.empty() ? task.name : task.name + ", " + task.group;
}

// Runs one task; what it throws leaves as a TaskError.
void run_task(const Task& task, TaskRecord& record) {
    try {
        BodyScope scope(record);
        task.body();
        scope.finished();
    } catch (const std::exception& error) {
        throw TaskError(label(task), message_of(error));
    } catch (...) {
        throw TaskError(label(task), "an exception of unknown type");
    }
}

std::vector<Task> checked(std::vector<Task> listing) {
    for (std::size_t task = 0; task < listing.size(); ++task) {
        if (listing[task].name.empty())
            throw std::invalid_argument("task " + std::to_string(task + 1) + " of the listing has no name");
        if (!listing[task].body) throw std::invalid_argument("task '" + listing[task].name + "' has no body");
    }
    return listing;
}

}  // namespace

struct TaskGraph::Implementation {
    using Message = tbb::flow::continue_msg;
    using Node = tbb::flow::continue_node<Message>;

    Implementation(std::vector<Task> tasks, Executor& threads, Trace* trace)
        : listing(checked(std::move(tasks))), edges(derive_edges(listing)), records(listing.size()), executor(threads) {
        for (std::size_t task = 0; task < listing.size(); ++task) {
            names.push_back(listing[task].name);
            if (trace == nullptr) continue;
            records[task].trace = trace;
            records[task].event_name = trace->name_of_events(listing[task].name);
        }
        // A flow graph belongs to the arena in which it is made.
        executor.execute([this] { make_nodes(); });
    }

    void make_nodes() {
        flow = std::make_unique<tbb::flow::graph>();
        start = std::make_unique<tbb::flow::broadcast_node<Message>>(*flow);
        // TBB copies the bodies of nodes: they hold references to what lives here and nothing else.
        for (std::size_t task = 0; task < listing.size(); ++task)
            nodes.emplace_back(*flow, [&task_of_node = listing[task], &record = records[task]](const Message&) {
                run_task(task_of_node, record);
            });
        std::vector<bool> waits(listing.size());
        for (const Edge& edge : edges) {
            tbb::flow::make_edge(nodes[edge.from], nodes[edge.to]);
            waits[edge.to] = true;
        }
        for (std::size_t task = 0; task < listing.size(); ++task)
            if (!waits[task]) tbb::flow::make_edge(*start, nodes[task]);
    }

    void run() {
        try {
            start->try_put(Message{});
            flow->wait_for_all();
        } catch (...) {
            // Nodes have counted predecessors that finished before the failure; the next run must not find them done.
            flow->reset();
            throw;
        }
    }

    std::vector<Task> listing;
    std::vector<std::string> names;
    std::vector<Edge> edges;
    std::vector<TaskRecord> records;
    Executor& executor;
    std::unique_ptr<tbb::flow::graph> flow;  // outlives its nodes
    std::unique_ptr<tbb::flow::broadcast_node<Message>> start;
    std::deque<Node> nodes;
};

TaskGraph::TaskGraph(std::vector<Task> listing, Executor& executor, Trace* trace)
    : implementation_(std::make_unique<Implementation>(std::move(listing), executor, trace)) {}
TaskGraph::~TaskGraph() = default;
TaskGraph::TaskGraph(TaskGraph&&) noexcept = default;
TaskGraph& TaskGraph::operator=(TaskGraph&&) noexcept = default;

void TaskGraph::run() {
    implementation_->executor.execute([this] { implementation_->run(); });
}

void TaskGraph::run_in_listing_order() {
    for (std::size_t task = 0; task < size(); ++task)
        run_task(implementation_->listing[task], implementation_->records[task]);
}

std::size_t TaskGraph::size() const {
    return implementation_->listing.size();
}
std::span<const Task> TaskGraph::listing() const {
    return implementation_->listing;
}
std::span<const std::string> TaskGraph::names() const {
    return implementation_->names;
}
std::span<const Edge> TaskGraph::edges() const {
    return implementation_->edges;
}

TaskStatistics TaskGraph::statistics(std::size_t task) const {
    const TaskRecord& record = implementation_->records.at(task);
    return {record.runs, 1e-9 * static_cast<double>(record.wall_nanoseconds),
            1e-9 * static_cast<double>(record.busy_nanoseconds.load()), record.work_items.load()};
}

std::vector<TaskStatistics> TaskGraph::statistics() const {
    std::vector<TaskStatistics> all;
    for (std::size_t task = 0; task < size(); ++task) all.push_back(statistics(task));
    return all;
}

void TaskGraph::reset_statistics() {
    for (TaskRecord& record : implementation_->records) {
        record.busy_nanoseconds = 0;
        record.work_items = 0;
        record.wall_nanoseconds = 0;
        record.runs = 0;
    }
}

}  // namespace aquagraph::tasks
