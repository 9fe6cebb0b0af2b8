#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>

#include "study/sweep/sqlite.hpp"
#include "tests/apps/command_line.hpp"

namespace rtu::test {
namespace {

// A cluster of one node on this machine: controller and node daemon on the loopback, everything in a folder,
// no service, no authentication.
class SweepSlurm : public CommandLine {
  protected:
    void SetUp() override {
        if (sanitized_program() != nullptr) GTEST_SKIP() << "takes too long under the sanitizers";
        for (const char* program : {"slurmctld", "slurmd", "sbatch", "squeue"}) {
            if (shell(std::string("command -v ") + program).exit_code != 0)
                GTEST_SKIP() << "Slurm is not installed (package slurm-wlm)";
        }
        if (::geteuid() != 0) GTEST_SKIP() << "Slurm's node daemon must be started by root";
        write_configuration();
        controller_.emplace(folder_.path(),
                            std::vector<std::string>{"/bin/sh", "-c", "exec slurmctld -D -c"});
        node_.emplace(folder_.path() / "cluster",
                      std::vector<std::string>{"/bin/sh", "-c", "exec slurmd -D -N node"});
        for (int i = 0; i < 100 && shell("sinfo -h -o %T").out != "idle\n"; ++i) ::usleep(100'000);
        ASSERT_EQ(shell("sinfo -h -o %T").out, "idle\n");
    }
    void TearDown() override {
        for (auto* daemon : {&node_, &controller_}) {
            if (!*daemon) continue;
            ::kill((*daemon)->id(), SIGKILL);
            static_cast<void>((*daemon)->wait());
        }
        ::unsetenv("SLURM_CONF");
        std::filesystem::remove_all(spool_);
    }

    void write_configuration() const {
        const std::filesystem::path cluster = folder_.path() / "cluster";
        std::filesystem::create_directories(cluster / "state");
        std::filesystem::create_directories(spool_);
        const int port = 20'000 + int(::getpid() % 20'000);
        const std::string host = shell("hostname -s").out;
        std::ofstream(cluster / "slurm.conf") << fmt::format(
            "ClusterName=loopback\nSlurmctldHost={0}(127.0.0.1)\nSlurmUser=root\nSlurmdUser=root\n"
            "AuthType=auth/none\nCredType=cred/none\nSlurmctldPort={2}\nSlurmdPort={3}\n"
            "StateSaveLocation={1}/state\nSlurmdSpoolDir={4}\nSlurmctldPidFile={1}/ctld.pid\n"
            "SlurmdPidFile={1}/d.pid\nSlurmctldLogFile={1}/ctld.log\nSlurmdLogFile={1}/d.log\n"
            "ProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\n"
            "JobAcctGatherType=jobacct_gather/none\nAccountingStorageType=accounting_storage/none\n"
            "SelectType=select/cons_tres\nSelectTypeParameters=CR_Core\nSchedulerType=sched/backfill\n"
            "SchedulerParameters=sched_min_interval=0,batch_sched_delay=0\nSwitchType=switch/none\n"
            "MpiDefault=none\nReturnToService=2\nSlurmdParameters=config_overrides\n"
            "NodeName=node NodeHostname={0} NodeAddr=127.0.0.1 CPUs=2 RealMemory=1000 State=UNKNOWN\n"
            "PartitionName=all Nodes=node Default=YES MaxTime=INFINITE State=UP\n",
            host.substr(0, host.find('\n')), cluster.string(), port, port + 1, spool_.string());
        ::setenv("SLURM_CONF", (cluster / "slurm.conf").c_str(), 1);
    }
    ProcessResult shell(const std::string& line) const {
        return Process(folder_.path() / ".", {"/bin/bash", "-c", line}).wait();
    }
    std::string rows(const std::string& database, const std::string& sql) const {
        const study::SqlDatabase connection(folder_.path() / database, study::SqlDatabase::Mode::ReadOnly);
        study::SqlStatement rows = connection.prepare(sql);
        std::string text;
        while (rows.next()) {
            for (int i = 0; i < rows.column_count(); ++i) text += rows.text(i) + '|';
            text += '\n';
        }
        return text;
    }

    // Kills task 0 once it has done a point. The name of a journal ends in the id of its process.
    static void kill_task_within(const std::filesystem::path& work) {
        std::string process;
        for (int i = 0; i < 10'000 && process.empty(); ++i) {
            ::usleep(2'000);
            for (const auto& entry : std::filesystem::directory_iterator(work)) {
                const std::string name = entry.path().filename();
                const bool is_journal = name.ends_with(".journal") && name.find("-0-") != std::string::npos;
                if (is_journal && entry.file_size() > 0)
                    process = name.substr(name.rfind('-') + 1, name.rfind('.') - name.rfind('-') - 1);
            }
        }
        ASSERT_NE(process, "");
        EXPECT_EQ(::kill(std::stoi(process), SIGKILL), 0);
    }

  private:
    // Sockets lie there, and the path of a socket has at most 107 characters.
    const std::filesystem::path spool_ =
        std::filesystem::temp_directory_path() / fmt::format("rtusim_spool_{}", ::getpid());
    std::optional<Process> controller_, node_;
};

// The sweep is killed, and another one goes on with its array; a task is killed in the middle, and what it
// left is submitted once more.
TEST_F(SweepSlurm, GivesWhatLocalProcessesGive) {
    static_cast<void>(folder_.write(
        "s.toml",
        "scenes = [\"ball.glb\"]\nworkloads = [\"primary\", \"diffuse\"]\nresolution = [160, 160]\n"
        "[axes]\nrtu.ray_slots = { from = 1, to = 8, step = 1 }\n"));
    std::vector<std::string> on_cluster{"sweep",          "s.toml", "--output",          "cluster.db",
                                        "--executor",     "slurm",  "--points-per-task", "4",
                                        "--poll-seconds", "0.2"};
    std::vector<std::string> delayed = on_cluster;
    delayed.emplace_back("--sbatch=--begin=now+600");
    Process first = start(delayed);
    std::string job;
    for (int i = 0; i < 200 && job.empty(); ++i) {
        ::usleep(50'000);
        job = shell("squeue -h -o %A | head -1 | tr -d '\\n'").out;
    }
    ASSERT_NE(job, "");
    ::kill(first.id(), SIGKILL);
    static_cast<void>(first.wait());
    const ProcessResult meanwhile = run({"sweep", "s.toml", "--output", "cluster.db"});
    EXPECT_EQ(meanwhile.exit_code, 1);
    EXPECT_THAT(meanwhile.err, testing::HasSubstr("Slurm still has job " + job));

    Process second = start(on_cluster);
    EXPECT_EQ(shell("scontrol update JobId=" + job + " StartTime=now").exit_code, 0);
    kill_task_within(folder_.path() / "cluster.db.work");
    const ProcessResult resumed = second.wait();
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;

    ASSERT_EQ(run({"sweep", "s.toml", "--output", "local.db"}).exit_code, 0);
    EXPECT_EQ(rows("cluster.db", "SELECT * FROM results"), rows("local.db", "SELECT * FROM results"));
    EXPECT_EQ(rows("cluster.db", "SELECT count(*), max(completions) FROM host"), "8|1|\n");
    EXPECT_EQ(run({"diff", "local.db", "cluster.db", "--tolerance", "0"}).exit_code, 0);
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "cluster.db.work"));
}

}  // namespace
}  // namespace rtu::test
