#include "io/pending_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/file.h"
#include "temp_folder.h"

namespace etd {
namespace {

namespace fs = std::filesystem;

TEST(PendingFile, TakesItsNameWhenItIsComplete) {
  const TempFolder folder;
  const fs::path path = folder.write("a.txt", "old");
  {
    PendingFile file(path);
    file.write("half", 4);
    EXPECT_EQ(folder.entries(), 2);
  }
  EXPECT_EQ(read_file(path).bytes, "old");
  PendingFile file(path);
  file.write("new....", 7);
  file.seek(3);
  file.write("er", 2);
  EXPECT_EQ(read_file(path).bytes, "old");
  EXPECT_EQ(file.commit(), "");
  EXPECT_EQ(read_file(path).bytes, "newer..");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(PendingFile, LinksStayLinksAlsoWhereTheyLeadToNothingYet) {
  const TempFolder folder;
  folder.write("old.txt", "old");
  fs::create_directory(folder.path() / "below");
  fs::create_symlink("old.txt", folder.path() / "a");
  fs::create_symlink("below/new.txt", folder.path() / "b");  // relative to the link's folder
  fs::create_symlink(folder.path() / "b", folder.path() / "c");
  for (const auto& [link, target] :
       {std::pair("a", "old.txt"), std::pair("b", "below/new.txt"), std::pair("c", "below/new.txt")}) {
    EXPECT_EQ(place_problem(folder.path() / link), "");
    ASSERT_EQ(write_file(folder.path() / link, link), "");
    EXPECT_TRUE(fs::is_symlink(folder.path() / link)) << link;
    EXPECT_EQ(read_file(folder.path() / target).bytes, link);
    EXPECT_EQ(follow_links(folder.path() / link), folder.path() / target);
  }
  const std::string nowhere = (folder.path() / "absent").string();
  fs::create_symlink("absent/new.txt", folder.path() / "d");
  EXPECT_EQ(place_problem(folder.path() / "d"), "the folder " + nowhere + " does not exist");
  fs::create_symlink("e", folder.path() / "e");
  EXPECT_EQ(place_problem(folder.path() / "e"), "Too many levels of symbolic links");
}

TEST(PendingFile, NamesMayBeAsLongAsTheFileSystemAllows) {
  const TempFolder folder;
  for (const size_t length : {100u, 101u, 236u, 244u, 255u}) {
    const fs::path path = folder.path() / std::string(length, 'n');
    EXPECT_EQ(place_problem(path), "") << length;
    EXPECT_EQ(write_file(path, "all"), "") << length;
    EXPECT_EQ(read_file(path).bytes, "all") << length;
    fs::remove(path);
  }
  EXPECT_EQ(place_problem(folder.path() / std::string(256, 'n')), "File name too long");
  EXPECT_EQ(folder.entries(), 0);
}

TEST(PendingFile, ReplacesNothingButFiles) {
  EXPECT_EQ(place_problem("/dev/null"), "/dev/null is not a file that can be replaced");
  EXPECT_EQ(write_file("/dev/null", "text"), "cannot write /dev/null: /dev/null is not a file that can be replaced");
  EXPECT_EQ(place_problem("/tmp/"), "it names no file");
  EXPECT_EQ(place_problem(""), "it names no file");
}

// A process that begins to write and is killed.
void leave_pending(const fs::path& path, int killed_by) {
  const pid_t pid = ::fork();
  if (pid == 0) {
    const PendingFile file(path);
    if (killed_by == 0) {
      remove_pending_files();
      ::_exit(0);
    }
    ::raise(killed_by);
  }
  ::waitpid(pid, nullptr, 0);
}

TEST(PendingFile, WhatKilledProcessesLeaveIsRemovedByTheNextWriteOfTheSameFile) {
  const TempFolder folder;
  const std::string long_name(250, 'n');
  for (const std::string& name : {std::string("a.exr"), long_name}) leave_pending(folder.path() / name, SIGKILL);
  EXPECT_EQ(folder.entries(), 2);
  // Neither another output nor a file that only looks like one, nor one that is being written.
  leave_pending(folder.path() / "b.a.exr", SIGKILL);
  folder.write(".a.exr.mine.part", "");
  folder.write(".a.exr.1-2.part.txt", "");
  PendingFile running(folder.path() / "a.exr");
  EXPECT_EQ(folder.entries(), 5);  // that of the killed process is gone, this one has come
  ASSERT_EQ(write_file(folder.path() / "a.exr", "first"), "");
  ASSERT_EQ(write_file(folder.path() / long_name, "long"), "");
  EXPECT_EQ(folder.entries(), 6);
  running.write("last", 4);
  EXPECT_EQ(running.commit(), "");
  EXPECT_EQ(read_file(folder.path() / "a.exr").bytes, "last");
  EXPECT_EQ(folder.entries(), 5);
  ASSERT_EQ(write_file(folder.path() / "b.a.exr", ""), "");
  EXPECT_EQ(folder.entries(), 5);
}

TEST(PendingFile, AProcessThatEndsAtOnceLeavesNothing) {
  const TempFolder folder;
  leave_pending(folder.path() / "a.exr", 0);
  EXPECT_EQ(folder.entries(), 0);
}

TEST(PendingFile, ErrorsNameTheFileOnce) {
  const TempFolder folder;
  EXPECT_EQ(write_file(folder.path() / "none" / "a.txt", "text"),
            "cannot write " + (folder.path() / "none/a.txt").string() + ": cannot create a file in " +
                (folder.path() / "none").string() + ": No such file or directory");
}

}  // namespace
}  // namespace etd
