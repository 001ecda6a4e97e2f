// SPDX-License-Identifier: Apache-2.0
#include "studio/image/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "studio/errors.h"
#include "studio/image/test_folder.h"

namespace penumbra::studio {
namespace {

std::string textOf(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = readWholeFile(path);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string messageOf(auto&& call) {
    try {
        call();
    } catch (const OutputError& error) {
        return error.what();
    }
    return "no OutputError";
}

TEST(AtomicFile, WritesAndReplaces) {
    const TestFolder folder;
    writeFileAtomically(folder / "a.txt", "first");
    writeFileAtomically(folder / "a.txt", "second");
    EXPECT_EQ(textOf(folder / "a.txt"), "second");
    EXPECT_EQ(folder.fileCount(), 1);
}

TEST(AtomicFile, HasTheModeOfAnOrdinaryFile) {
    const TestFolder folder;
    writeFileAtomically(folder / "a.txt", "");
    std::FILE* ordinary = std::fopen((folder / "b.txt").c_str(), "w");
    std::fclose(ordinary);
    EXPECT_EQ(std::filesystem::status(folder / "a.txt").permissions(),
              std::filesystem::status(folder / "b.txt").permissions());
}

TEST(AtomicFile, WritesIntoTheCurrentFolder) {
    const TestFolder folder;
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    writeFileAtomically("plain.txt", "x");
    std::filesystem::current_path(before);
    EXPECT_EQ(textOf(folder / "plain.txt"), "x");
}

TEST(AtomicFile, RefusesAFolderThatIsMissingAndSaysSo) {
    const TestFolder folder;
    const std::string message = messageOf([&] { writeFileAtomically(folder / "no" / "a.txt", "x"); });
    EXPECT_NE(message.find("a.txt"), std::string::npos) << message;
    EXPECT_NE(message.find("create the folder"), std::string::npos) << message;
}

TEST(AtomicFile, RefusesToReplaceAFolder) {
    const TestFolder folder;
    std::filesystem::create_directory(folder / "taken");
    EXPECT_THROW(writeFileAtomically(folder / "taken", "x"), OutputError);
    EXPECT_THROW(writeFileAtomically(folder.path().string() + "/", "x"), OutputError);
    EXPECT_EQ(folder.fileCount(), 1);
}

TEST(AtomicFile, RefusesAFolderThatMayNotBeWrittenTo) {
    if (::geteuid() == 0) {
        EXPECT_THROW(writeFileAtomically("/proc/a.txt", "x"), OutputError);  // permissions do not bind root
        return;
    }
    const TestFolder folder;
    std::filesystem::permissions(folder.path(),
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    EXPECT_THROW(writeFileAtomically(folder / "a.txt", "x"), OutputError);
    std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

TEST(AtomicFile, AWriteThatFailsHalfwayLeavesTheOldFileAndNoOther) {
    const TestFolder folder;
    writeFileAtomically(folder / "a.txt", "old");
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit small = before;
    small.rlim_cur = 4096;
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const std::string message =
        messageOf([&] { writeFileAtomically(folder / "a.txt", std::string(100'000, 'n')); });
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_NE(message.find("free some space"), std::string::npos) << message;
    EXPECT_EQ(textOf(folder / "a.txt"), "old");
    EXPECT_EQ(folder.fileCount(), 1);
}

TEST(AtomicFile, ASignalLeavesNoUnfinishedFile) {
    const TestFolder folder;
    for (int i = 0; i < 20; ++i) {
        std::filesystem::remove(folder / "a.txt");  // it tells that the child is ready for signals
        const pid_t child = ::fork();
        if (child == 0) {
            ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // it must not outlive a test that was ended
            std::signal(SIGINT, SIG_DFL);        // which a shell's background jobs ignore
            removeUnfinishedFilesOnSignals();
            const std::string text(1'000'000, 'x');  // so that nearly always one is being written
            for (;;) writeFileAtomically(folder / "a.txt", text);
        }
        ASSERT_GT(child, 0);
        while (!std::filesystem::exists(folder / "a.txt")) std::this_thread::yield();
        ::kill(child, i % 2 == 0 ? SIGTERM : SIGINT);
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        EXPECT_TRUE(WIFSIGNALED(status)) << "the signal must have its usual effect";
        EXPECT_EQ(folder.fileCount(), 1);
    }
}

TEST(ReadWholeFile, RefusesWhatItCannotRead) {
    const TestFolder folder;
    writeFileAtomically(folder / "a.txt", "12345");
    EXPECT_THROW(readWholeFile(folder / "b.txt"), InputError);
    EXPECT_THROW(readWholeFile(folder.path()), InputError);
    EXPECT_THROW(readWholeFile(folder / "a.txt", 4), InputError);
    EXPECT_EQ(readWholeFile(folder / "a.txt", 5).size(), 5u);
}

}  // namespace
}  // namespace penumbra::studio
