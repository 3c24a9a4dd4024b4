// How an exception inside a task reaches the user: one message that names the task, the original kept inside.
#pragma once
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace aquagraph::tasks {

// what() is "in task 'fluxes (stage 2)': <message of the original>". The original keeps its type: rethrow_nested()
// throws it again, cause() hands it out.
class TaskError : public std::runtime_error, public std::nested_exception {
  public:
    // Made inside a catch block: std::nested_exception takes hold of the exception being handled.
    TaskError(std::string task, const std::string& message)
        : std::runtime_error("in task '" + task + "': " + message), task_(std::move(task)) {}

    const std::string& task() const noexcept { return task_; }
    std::exception_ptr cause() const noexcept { return nested_ptr(); }

  private:
    std::string task_;
};

}  // namespace aquagraph::tasks
