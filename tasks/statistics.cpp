#include "tasks/statistics.hpp"

#include "tasks/measurement.hpp"

namespace aquagraph::tasks {

void report_work(std::uint64_t items) {
    if (current_frame != nullptr) current_frame->record->work_items.fetch_add(items, std::memory_order_relaxed);
}

}  // namespace aquagraph::tasks
