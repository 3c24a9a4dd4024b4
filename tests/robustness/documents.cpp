// What the documents promise: shipped scenes pass check, studies can be read, links lead somewhere, commands are
// understood.
#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <sstream>

#include "engine/check.hpp"
#include "engine/study_runs.hpp"
#include "io/study_file.hpp"
#include "tests/robustness/program.hpp"

using namespace aquagraph;
using namespace aquagraph::test;
namespace fs = std::filesystem;

namespace {

const fs::path root = AQUAGRAPH_SOURCE_DIR;

std::vector<fs::path> files_below(const fs::path& folder, const std::string& end) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().filename().string().ends_with(end)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

std::vector<fs::path> documents() {
    std::vector<fs::path> files = files_below(root / "benchmarks", ".md");
    files.insert(files.begin(), root / "README.md");
    return files;
}

struct Command {
    fs::path document;
    std::vector<std::string> words;  // behind "aquagraph"

    // What follows this option, each time.
    std::vector<std::string> values_of(const std::string& option) const {
        std::vector<std::string> values;
        for (std::size_t k = 0; k + 1 < words.size(); ++k)
            if (words[k] == option) values.push_back(words[k + 1]);
        return values;
    }
};

// "./aquagraph VERB ..." to the end of the line, of the code it stands in, or to a comment.
std::vector<Command> commands() {
    std::vector<Command> found;
    const std::regex call(R"(\./aquagraph ([^`#\n]*))");
    for (const fs::path& document : documents()) {
        const std::string text = contents(document);
        for (std::sregex_iterator it(text.begin(), text.end(), call); it != std::sregex_iterator(); ++it) {
            std::istringstream line((*it)[1]);
            Command command{document, {}};
            for (std::string word; line >> word && word != "&&";) {
                std::erase_if(word, [](char c) { return c == '[' || c == ']'; });
                command.words.push_back(word);
            }
            found.push_back(command);
        }
    }
    return found;
}

}  // namespace

TEST_CASE("every scene that is shipped passes check") {
    int scenes = 0;
    for (const fs::path& file : files_below(root / "benchmarks", ".toml")) {
        if (file.filename().string().ends_with(".study.toml")) continue;
        CAPTURE(file);
        std::ostringstream said;
        CHECK_NOTHROW(engine::check(io::read_scene(file), 2, said));
        CHECK(said.str().find("run time   about ") != std::string::npos);
        ++scenes;
    }
    CHECK(scenes >= 28);
}

TEST_CASE("every run of every study that is shipped has a scene that is read") {
    for (const fs::path& file : files_below(root / "benchmarks", ".study.toml")) {
        CAPTURE(file);
        const io::Study study = io::read_study(file);
        CHECK(engine::runs_of(study, false, {}, AQUAGRAPH_PROGRAM, 1).size() >= study.cases.size());
    }
}

TEST_CASE("tables in READMEs that a study writes stand beside a scene of that study") {
    const std::regex marker("<!-- begin study (\\w+)/(\\w+) -->");
    int tables = 0;
    for (const fs::path& document : files_below(root / "benchmarks", "README.md")) {
        CAPTURE(document);
        const std::string text = contents(document);
        for (std::sregex_iterator it(text.begin(), text.end(), marker); it != std::sregex_iterator(); ++it) {
            const std::string name = (*it)[2];
            CAPTURE(name);
            const io::Study study = io::read_study(root / "benchmarks" / ((*it)[1].str() + ".study.toml"));
            const auto one = std::find_if(study.cases.begin(), study.cases.end(),
                                          [&](const io::StudyCase& other) { return other.name == name; });
            REQUIRE(one != study.cases.end());
            CHECK(one->scene.parent_path() == document.parent_path());
            CHECK(text.find("<!-- end study " + study.name + "/" + name + " -->") != std::string::npos);
            ++tables;
        }
    }
    CHECK(tables >= 15);
}

TEST_CASE("links between documents lead somewhere") {
    const std::regex link(R"(\]\(([^)#\s]+)[^)]*\))");
    int links = 0;
    for (const fs::path& document : documents()) {
        const std::string text = contents(document);
        for (std::sregex_iterator it(text.begin(), text.end(), link); it != std::sregex_iterator(); ++it) {
            const std::string target = (*it)[1];
            if (target.find("://") != std::string::npos) continue;
            CAPTURE(document);
            CAPTURE(target);
            CHECK(fs::exists(document.parent_path() / target));
            ++links;
        }
    }
    CHECK(links > 50);
}

TEST_CASE("commands in documents are those of the program, with scenes, overrides and studies that are there") {
    const std::vector<Command> all = commands();
    CHECK(all.size() > 30);
    std::map<std::string, std::string> help;
    for (const Command& command : all) {
        CAPTURE(command.document);
        REQUIRE(!command.words.empty());
        const std::string verb = command.words[0];
        CAPTURE(verb);
        if (verb == "test" || verb == "build" || verb == "measure" || verb == "help") continue;  // the launcher's own
        if (!help.contains(verb)) {
            const Call call({verb, "--help"});
            REQUIRE(call.code == 0);
            help[verb] = call.out;
        }
        for (const std::string& word : command.words)
            if (word.starts_with("--")) {
                CAPTURE(word);
                CHECK(help[verb].find(word + " ") != std::string::npos);
            }
        if (command.words.size() < 2 || !command.words[1].ends_with(".toml")) continue;
        const fs::path file = root / command.words[1];
        CAPTURE(file);
        if (verb != "study") {
            CHECK_NOTHROW(io::read_scene(file, command.values_of("--set")));
            continue;
        }
        const auto runs =
            engine::runs_of(io::read_study(file), false, command.values_of("--only"), AQUAGRAPH_PROGRAM, 1);
        CHECK(!runs.empty());
    }
}

TEST_CASE("the launcher passes on every command of the program") {
    const std::string launcher = contents(root / "aquagraph"), all = Call({}).err;
    std::smatch listed;
    REQUIRE(std::regex_search(all, listed, std::regex("give a command: ([^;]*);")));
    std::istringstream names(std::regex_replace(listed.str(1), std::regex(","), " "));
    int commands = 0;
    for (std::string name; names >> name; ++commands) {
        CAPTURE(name);
        CHECK(std::regex_search(launcher, std::regex(R"(\n-\*[^\n]* \| )" + name + R"([ )])")));
    }
    CHECK(commands >= 7);
}
