#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

#include "tests/apps/command_line.hpp"

namespace rtu::test {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

class TimelineCommand : public CommandLine {
  protected:
    ProcessResult timeline(std::vector<std::string> more) const {
        more.insert(more.begin(), {"timeline", "ball.glb", "--resolution", "16x16"});
        return run(more);
    }
};

TEST_F(TimelineCommand, HelpTeaches) {
    const ProcessResult result = run({"timeline", "--help"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.out, AllOf(HasSubstr("Examples:"), HasSubstr("--from"), HasSubstr("ui.perfetto.dev")));
}

// A thread's complete events must nest: each ends within the one that is open, or begins behind it.
void expect_nested(const std::vector<std::pair<std::uint64_t, std::uint64_t>>& spans) {
    std::vector<std::uint64_t> open;
    for (const auto& [begin, end] : spans) {
        while (!open.empty() && open.back() <= begin) open.pop_back();
        ASSERT_TRUE(open.empty() || end <= open.back());
        open.push_back(end);
    }
    ASSERT_LE(open.size(), 2U);
}

// The rules of the Trace Event Format for the phases that are used.
TEST_F(TimelineCommand, WritesATraceAsTheFormatHasIt) {
    const ProcessResult result = timeline({"--from", "300", "--cycles", "400", "--json", "-"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Json trace = Json::parse(result.out);
    EXPECT_EQ(trace["otherData"]["from_cycle"], 300);
    std::map<int, std::string> processes;
    std::set<std::pair<int, int>> threads;
    std::map<std::pair<int, int>, std::vector<std::pair<std::uint64_t, std::uint64_t>>> complete;
    std::map<std::pair<int, std::uint64_t>, std::uint64_t> open;
    std::uint64_t last = 0;
    std::map<std::string, int> phases;
    for (const Json& event : trace["traceEvents"]) {
        const std::string phase = event.at("ph");
        const std::pair<int, int> thread{event.at("pid"), event.at("tid")};
        ASSERT_TRUE(event.at("name").is_string());
        ++phases[phase];
        if (phase == "M") {
            const std::string name = event.at("args").at("name");
            if (event["name"] == "process_name") processes[thread.first] = name;
            if (event["name"] == "thread_name") {
                ASSERT_TRUE(threads.insert(thread).second);
            }
            continue;
        }
        ASSERT_TRUE(processes.contains(thread.first) && threads.contains(thread));
        const std::uint64_t ts = event.at("ts");
        ASSERT_GE(ts, last) << "events must be in order";
        ASSERT_TRUE(ts >= 300 && ts <= 700);
        last = ts;
        if (phase == "X") {
            const std::uint64_t end = ts + std::uint64_t(event.at("dur"));
            ASSERT_LE(end, 700U);
            complete[thread].emplace_back(ts, end);
        } else if (phase == "b") {
            ASSERT_TRUE(event.at("cat").is_string());
            ASSERT_TRUE(open.emplace(std::pair{thread.first, event.at("id")}, ts).second);
            ASSERT_TRUE(event.at("args").at("address").is_string());
        } else if (phase == "e") {
            ASSERT_EQ(open.erase({thread.first, event.at("id")}), 1U);
        } else {
            ASSERT_EQ(phase, "n");
        }
    }
    EXPECT_THAT(open, IsEmpty());
    for (const auto& [thread, spans] : complete) expect_nested(spans);
    EXPECT_EQ(processes[1], "units");
    EXPECT_EQ(processes[2], "rtu0 ray slots");
    EXPECT_GT(phases["X"], 500);
    EXPECT_GT(phases["b"], 100);
}

TEST_F(TimelineCommand, IsTheSameWhateverTheThreadsAndTheClockMode) {
    const ProcessResult one = timeline({"--threads", "1", "--json", "-", "--vcd", "one.vcd"});
    const ProcessResult many = timeline({"--clock-mode", "verify", "--json", "-", "--vcd", "many.vcd"});
    EXPECT_EQ(one.exit_code, 0) << one.err;
    EXPECT_EQ(one.out, many.out);
    EXPECT_EQ(content("one.vcd"), content("many.vcd"));
}

// Lines that are values, with the time in front of each.
std::vector<std::string> values_of(const std::string& vcd) {
    std::istringstream in(vcd.substr(vcd.find("$enddefinitions")));
    std::map<std::string, std::string> names;
    std::istringstream head(vcd.substr(0, vcd.find("$enddefinitions")));
    std::string scope;
    for (std::string line; std::getline(head, line);) {
        std::istringstream words(line);
        std::string word, kind, bits, id, name;
        words >> word;
        if (word == "$scope" && words >> kind >> name) scope += name + ".";
        if (word == "$upscope") scope.erase(scope.rfind('.', scope.size() - 2) + 1);
        if (word == "$var" && words >> kind >> bits >> id >> name) names[id] = scope + name;
    }
    std::vector<std::string> values;
    std::string time;
    std::getline(in, scope);
    for (std::string line; std::getline(in, line);) {
        if (line.empty() || line[0] == '$') continue;
        if (line[0] == '#') {
            time = line;
            continue;
        }
        const std::size_t blank = line[0] == 'b' ? line.find(' ') + 1 : 1;
        std::string value = line.substr(0, blank);
        if (value[0] == 'b') value.erase(1, std::min(value.find('1', 1), value.size() - 2) - 1);
        values.push_back(time + " " + names[line.substr(blank)] + " " + value);
    }
    return values;
}

TEST_F(TimelineCommand, WritesWaveformsThatGtkwavesReadersRead) {
    if (std::system("command -v vcd2fst >/dev/null && command -v fst2vcd >/dev/null") != 0) {
        GTEST_SKIP() << "no vcd2fst and fst2vcd here: they come with gtkwave";
    }
    const ProcessResult result = timeline({"--from", "300", "--cycles", "20000", "--vcd", "t.vcd"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::string folder = folder_.path().string();
    const std::string convert =
        "cd '" + folder + "' && vcd2fst t.vcd t.fst >/dev/null && " + "fst2vcd t.fst > back.vcd 2>/dev/null";
    ASSERT_EQ(std::system(convert.c_str()), 0);
    std::vector<std::string> written = values_of(content("t.vcd")), read = values_of(content("back.vcd"));
    EXPECT_GT(written.size(), 1'000U);
    std::ranges::sort(written);
    std::ranges::sort(read);
    EXPECT_EQ(written, read);
    EXPECT_THAT(content("t.vcd"), AllOf(HasSubstr("$scope module rtu0 $end"), HasSubstr("$timescale")));
}

TEST_F(TimelineCommand, RefusesWindowsThatAreNone) {
    const ProcessResult late = timeline({"--from", "1000000000", "--vcd", "t.vcd"});
    EXPECT_EQ(late.exit_code, 1);
    EXPECT_THAT(late.err, HasSubstr("expected a window that begins before cycle"));
    EXPECT_EQ(timeline({"--cycles", "0"}).exit_code, 2);
    EXPECT_EQ(timeline({"--cycles", "1000001"}).exit_code, 2);
    EXPECT_EQ(timeline({"--from", "-1"}).exit_code, 2);
    EXPECT_EQ(timeline({"--workload", "primary,shadow"}).exit_code, 1);
    const ProcessResult same = timeline({"--json", "t", "--vcd", "./t"});
    EXPECT_EQ(same.exit_code, 1);
    EXPECT_THAT(same.err, HasSubstr("the same file"));
    EXPECT_EQ(timeline({"--json", "ball.glb"}).exit_code, 1);
    EXPECT_THAT(names(), testing::ElementsAre("ball.glb"));
}

}  // namespace
}  // namespace rtu::test
