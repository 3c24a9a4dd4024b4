// The built program as a user starts it: a child process with its own folder, its output caught in files.
#pragma once
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <optional>
#include <thread>

#include "tests/engine/results_of_run.hpp"

namespace aquagraph::test {

class Program {
  public:
    // Started in `folder`, which also receives out.txt and err.txt.
    Program(const ScratchFolder& folder, std::vector<std::string> arguments)
        : out_(folder / "out.txt"), err_(folder / "err.txt") {
        arguments.insert(arguments.begin(), AQUAGRAPH_PROGRAM);
        std::vector<char*> pointers;
        for (std::string& argument : arguments) pointers.push_back(argument.data());
        pointers.push_back(nullptr);
        const std::string working_folder = (folder / ".").string();
        child_ = fork();
        if (child_ < 0) throw std::runtime_error("fork failed");
        if (child_ > 0) return;
        // In the child: nothing but system calls until the program takes over.
        const auto redirect = [](const std::string& file, int descriptor) {
            const int to = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
            if (to < 0 || dup2(to, descriptor) < 0) _exit(126);
        };
        redirect(out_.string(), STDOUT_FILENO);
        redirect(err_.string(), STDERR_FILENO);
        if (chdir(working_folder.c_str()) != 0) _exit(126);
        execv(pointers[0], pointers.data());
        _exit(127);
    }
    ~Program() {
        if (running()) {
            kill(child_, SIGKILL);
            waitpid(child_, nullptr, 0);
        }
    }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    bool running() {
        if (status_) return false;
        int status = 0;
        if (waitpid(child_, &status, WNOHANG) == child_) status_ = status;
        return !status_;
    }
    void send(int signal) const { kill(child_, signal); }

    // The exit code; 128 + signal for a crash; none if it has not ended within the limit.
    std::optional<int> wait(std::chrono::seconds limit = std::chrono::seconds(20)) {
        const auto end = std::chrono::steady_clock::now() + limit;
        while (running() && std::chrono::steady_clock::now() < end)
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        if (!status_) return std::nullopt;
        return WIFEXITED(*status_) ? WEXITSTATUS(*status_) : 128 + WTERMSIG(*status_);
    }
    std::string out() const { return contents(out_); }
    std::string err() const { return contents(err_); }

  private:
    std::filesystem::path out_, err_;
    pid_t child_ = -1;
    std::optional<int> status_;
};

// The program run to its end in a folder of its own.
struct Call {
    ScratchFolder folder;
    std::string scene_file;
    std::optional<int> code;
    std::string out, err;

    // `arguments` may say SCENE for the scene's file and FOLDER for the folder.
    explicit Call(std::vector<std::string> arguments, const std::string& scene = "") {
        if (!scene.empty()) scene_file = folder.write("scene.toml", scene).string();
        for (std::string& argument : arguments) {
            if (argument == "SCENE") argument = "scene.toml";
            if (argument.starts_with("FOLDER")) argument = (folder / "").string() + argument.substr(7);
        }
        Program program(folder, arguments);
        code = program.wait();
        out = program.out();
        err = program.err();
    }
    bool left_nothing() const {  // but the scene and what the program said
        for (const auto& entry : std::filesystem::directory_iterator(folder / ".")) {
            const std::string name = entry.path().filename().string();
            if (name != "scene.toml" && name != "out.txt" && name != "err.txt") return false;
        }
        return true;
    }
    ResultsFolder results(const std::string& name = "results") const { return {folder / name}; }
};

}  // namespace aquagraph::test
