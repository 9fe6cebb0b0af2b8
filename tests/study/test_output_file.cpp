#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <sstream>
#include <vector>

#include "model/error.hpp"
#include "study/output_file.hpp"

namespace rtu::study {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

// A folder that lives as long as the test.
class OutputFileTest : public testing::Test {
  protected:
    OutputFileTest()
        : folder_(fs::path(testing::TempDir()) /
                  (std::string("rtusim_") + testing::UnitTest::GetInstance()->current_test_info()->name())) {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    ~OutputFileTest() override { fs::remove_all(folder_); }

    static std::string content(const fs::path& path) {
        std::stringstream text;
        text << std::ifstream(path).rdbuf();
        return text.str();
    }
    std::vector<std::string> names() const {
        std::vector<std::string> result;
        for (const auto& entry : fs::directory_iterator(folder_)) result.push_back(entry.path().filename());
        return result;
    }
    static std::string error(const std::function<void()>& action) {
        try {
            action();
        } catch (const Error& e) {
            return e.what();
        }
        return "no error";
    }

    fs::path folder_;
};

TEST_F(OutputFileTest, WritesAllFilesAndNothingElse) {
    const std::string binary("a\0b", 3);
    write_files(std::vector<OutputFile>{{folder_ / "a.txt", "first"}, {folder_ / "b.bin", binary}});
    EXPECT_EQ(content(folder_ / "a.txt"), "first");
    EXPECT_EQ(content(folder_ / "b.bin"), binary);
    EXPECT_THAT(names(), UnorderedElementsAre("a.txt", "b.bin"));
}

TEST_F(OutputFileTest, ReplacesAFileAsAWhole) {
    std::ofstream(folder_ / "a.txt") << "a much longer text that was there";
    write_files(std::vector<OutputFile>{{folder_ / "a.txt", "new"}});
    EXPECT_EQ(content(folder_ / "a.txt"), "new");
}

TEST_F(OutputFileTest, ReplacesAFileInMemoryAsAWhole) {
    if (!fs::is_directory("/dev/shm")) GTEST_SKIP() << "no /dev/shm here";
    const fs::path path = "/dev/shm/rtusim_output_file_test_" + std::to_string(::getpid());
    write_files(std::vector<OutputFile>{{path, "much longer than what follows"}});
    write_files(std::vector<OutputFile>{{path, "short"}});
    EXPECT_EQ(content(path), "short");
    fs::remove(path);
}

TEST_F(OutputFileTest, WritesThroughALink) {
    std::ofstream(folder_ / "target") << "old";
    fs::create_symlink("target", folder_ / "link");
    write_files(std::vector<OutputFile>{{folder_ / "link", "new"}});
    EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
    EXPECT_EQ(content(folder_ / "target"), "new");
}

TEST_F(OutputFileTest, MakesMissingFolders) {
    write_files(std::vector<OutputFile>{{folder_ / "x" / "y" / "a.txt", "deep"}});
    EXPECT_EQ(content(folder_ / "x" / "y" / "a.txt"), "deep");
}

TEST_F(OutputFileTest, WritesNoneWhenOneFails) {
    std::ofstream(folder_ / "a.txt") << "old";
    const std::vector<OutputFile> files{{folder_ / "a.txt", "new"}, {fs::path("/proc/no-file-here"), "x"}};
    EXPECT_THAT(error([&] { write_files(files); }), HasSubstr("/proc/no-file-here: cannot write"));
    EXPECT_EQ(content(folder_ / "a.txt"), "old");
    EXPECT_THAT(names(), UnorderedElementsAre("a.txt"));
}

TEST_F(OutputFileTest, ReportsAFullDiskAndWritesNothingElse) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    EXPECT_NO_THROW(check_writable("/dev/full"));  // only writing tells
    const std::vector<OutputFile> files{{folder_ / "a.txt", "a"}, {"/dev/full", "x"}};
    EXPECT_THAT(error([&] { write_files(files); }),
                HasSubstr("/dev/full: cannot write: No space left on device"));
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
    EXPECT_TRUE(names().empty());
}

TEST_F(OutputFileTest, AnInterruptLeavesNoTemporaryFile) {
    // A pipe that nobody reads holds the writer after it has staged a.txt and before it renames it.
    const fs::path pipe = folder_ / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        remove_temporaries_on_interrupt();
        write_files(std::vector<OutputFile>{{folder_ / "a.txt", "a"}, {pipe, "x"}});
        ::_exit(0);
    }
    while (names().size() < 2) ::usleep(1000);  // the test's time limit ends a wait in vain
    EXPECT_THAT(names(), testing::Contains(testing::EndsWith(".tmp")));
    ::kill(child, SIGTERM);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 128 + SIGTERM);
    EXPECT_THAT(names(), UnorderedElementsAre("pipe"));
}

TEST_F(OutputFileTest, RefusesInAdvanceWhatCannotBeWritten) {
    const auto check = [](const fs::path& path) { return error([&] { check_writable(path); }); };
    EXPECT_THAT(check(folder_), HasSubstr("Is a directory"));
    EXPECT_THAT(check(folder_ / "missing" / "a.txt"), HasSubstr("no folder"));
    EXPECT_THAT(check(""), HasSubstr("not the name of a file"));
    EXPECT_THAT(check(folder_ / "folder/"), HasSubstr("not the name of a file"));
    EXPECT_THAT(check("/proc/no-file-here"), HasSubstr("cannot write"));
    std::ofstream(folder_ / "file") << "x";
    EXPECT_THAT(check(folder_ / "file" / "a.txt"), HasSubstr("no folder"));
    EXPECT_EQ(check(folder_ / "file"), "no error");
    EXPECT_EQ(check(folder_ / "new"), "no error");
    EXPECT_THAT(names(), UnorderedElementsAre("file"));  // checking leaves nothing behind
}

TEST_F(OutputFileTest, ChecksAFolderThatIsStillToBeMade) {
    const auto check = [](const fs::path& path) { return error([&] { check_writable_folder(path); }); };
    EXPECT_EQ(check(folder_), "no error");
    EXPECT_EQ(check(folder_ / "x" / "y"), "no error");
    EXPECT_EQ(check("still-to-be-made"), "no error");
    std::ofstream(folder_ / "file") << "x";
    EXPECT_THAT(check(folder_ / "file"), HasSubstr("expected a folder"));
    EXPECT_THAT(check(folder_ / "file" / "x"), HasSubstr("expected a folder"));
    EXPECT_THAT(check("/proc/x"), HasSubstr("cannot write"));
    EXPECT_THAT(names(), UnorderedElementsAre("file"));
}

}  // namespace
}  // namespace rtu::study
