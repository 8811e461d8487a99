// The files of the fields as files; tests/scripts/fields_test.py reads them back.
#include "output/field_writer.hpp"

#include <cerrno>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>

#include <catch2/catch.hpp>

#include "temporary_folder.hpp"
#include "unit/output/frames.hpp"

using namespace stillpoint;
using stillpoint::test::a_frame, stillpoint::test::bytes_of, stillpoint::test::FullDisk, stillpoint::test::names_in,
    stillpoint::test::TemporaryFolder;
namespace fs = std::filesystem;
using Names = std::set<std::string>;

namespace {

std::size_t frames_in_xdmf(const fs::path& folder) {
  const std::string text = bytes_of(folder / "fields.xdmf");
  std::size_t frames = 0;
  for (std::size_t at = text.find("<Time"); at != std::string::npos; at = text.find("<Time", at + 1)) ++frames;
  return frames;
}

// Files below a folder that this process holds open.
int open_in(const fs::path& folder) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator("/proc/self/fd")) {
    std::error_code ignored;
    if (fs::read_symlink(entry, ignored).string().starts_with(folder.string())) ++count;
  }
  return count;
}

}  // namespace

TEST_CASE("the files of the fields have their names once they are whole") {
  const TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "new" / "folder";
  FieldWriter writer(folder);
  writer.add(a_frame(0));
  CHECK(names_in(folder) == Names{"fields.partial"});
  CHECK(names_in(folder / "fields.partial") == Names{"frame_0000.h5", "frame_0000.xdmf"});
  writer.finish();
  CHECK(names_in(folder) == Names{"fields.h5", "fields.xdmf"});
  CHECK(frames_in_xdmf(folder) == 1);
  CHECK(open_in(folder) == 0);
  writer.finish();  // once more is no harm
  CHECK(names_in(folder) == Names{"fields.h5", "fields.xdmf"});
  CHECK_THROWS_AS(writer.add(a_frame(1)), std::logic_error);
}

TEST_CASE("a writer that is never finished leaves its frames, and an earlier run's files alone") {
  const TemporaryFolder folder;
  folder.write("fields.h5", "earlier");
  folder.write("fields.xdmf", "earlier");
  {
    FieldWriter writer(folder.path());
    writer.add(a_frame(0));
    writer.add(a_frame(1));
  }
  CHECK(open_in(folder.path()) == 0);
  CHECK(names_in(folder.path()) == Names{"fields.h5", "fields.partial", "fields.xdmf"});
  CHECK(bytes_of(folder.path() / "fields.h5") == "earlier");
  CHECK(names_in(folder.path() / "fields.partial").size() == 4);
  FieldWriter next(folder.path());  // another run
  CHECK(names_in(folder.path() / "fields.partial").empty());
}

TEST_CASE("a writer that goes on after some frames leaves what one that was never broken off leaves") {
  for (const bool was_joined : {false, true}) {
    const TemporaryFolder folder, other;
    FieldWriter expected(other.path());
    {
      FieldWriter writer(folder.path());
      for (const double t : {0., 1., 2.}) writer.add(a_frame(t, t == 1 ? 7 : 3));
      if (was_joined) writer.finish();
    }
    FieldWriter writer(folder.path(), 2);
    for (const double t : {0., 1., 5.}) expected.add(a_frame(t, t == 1 ? 7 : 3));
    writer.add(a_frame(5));
    writer.finish();
    expected.finish();
    for (const char* name : {"fields.h5", "fields.xdmf"}) {
      CAPTURE(was_joined, name);
      CHECK((bytes_of(folder.path() / name) == bytes_of(other.path() / name)));
    }
    CHECK(names_in(folder.path()) == Names{"fields.h5", "fields.xdmf"});
    CHECK_THROWS_WITH(FieldWriter(folder.path(), 4), Catch::Contains("frame 3 is not there"));
  }
}

TEST_CASE("fields that cannot be written are a filesystem error, and leave nothing behind") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(FieldWriter(folder.write("a file", "")), fs::filesystem_error);

  FieldWriter writer(folder.path());
  const fs::path in_the_way = folder.path() / "fields.partial" / "frame_0000.h5.partial";
  fs::create_directories(in_the_way / "file");
  try {
    writer.add(a_frame(0));
    FAIL("a folder was taken for a file");
  } catch (const fs::filesystem_error& error) {
    CHECK(error.code() == std::errc::is_a_directory);
    CHECK(error.path1() == in_the_way);
  }
}

TEST_CASE("what HDF5 alone refuses is told in its words, without the system's error of something earlier") {
  const TemporaryFolder folder;
  FieldWriter writer(folder.path());
  FieldFrame frame = a_frame(0);
  frame.fields[2].name = "stress_xx";  // as the first component of stress is called
  errno = ENOENT;
  try {
    writer.add(frame);
    FAIL("two datasets of one name were written");
  } catch (const fs::filesystem_error& error) {
    CHECK(error.code() == std::errc::io_error);
    CHECK_THAT(error.what(), Catch::Contains("name already exists"));
  }
}

TEST_CASE("on a full disk a frame is refused as a whole, and the frames before it are kept") {
  const std::size_t points = 100000;
  for (const rlim_t room : {1 << 20, 2048, 0}) {
    const TemporaryFolder folder, other;
    FieldWriter writer(folder.path()), expected(other.path());
    writer.add(a_frame(0));
    expected.add(a_frame(0));
    {
      const FullDisk full(room);
      try {
        writer.add(a_frame(1, points));
        FAIL("the frame was written");
      } catch (const fs::filesystem_error& error) {
        CHECK(error.code() == std::errc::file_too_large);
        CHECK_THAT(error.what(), Catch::Contains("cannot write") && Catch::Contains("frame_0001"));
      }
    }
    CHECK(names_in(folder.path() / "fields.partial") == Names{"frame_0000.h5", "frame_0000.xdmf"});
    for (FieldWriter* each : {&writer, &expected}) each->add(a_frame(1, points));  // there is room again
    writer.finish();
    expected.finish();
    CHECK(open_in(folder.path()) == 0);
    CHECK(frames_in_xdmf(folder.path()) == 2);
    for (const char* name : {"fields.h5", "fields.xdmf"})
      CHECK((bytes_of(folder.path() / name) == bytes_of(other.path() / name)));
  }
}

TEST_CASE("on a disk that is full when the frames are joined they all stay, and are joined when there is room") {
  const TemporaryFolder folder;
  FieldWriter writer(folder.path());
  for (const double t : {0., 1., 2.}) writer.add(a_frame(t, 20000));
  {
    const FullDisk full(fs::file_size(folder.path() / "fields.partial" / "frame_0000.h5") * 2);
    CHECK_THROWS_WITH(writer.finish(), Catch::Contains("cannot write") && Catch::Contains("fields.h5"));
  }
  CHECK(names_in(folder.path()) == Names{"fields.partial"});
  CHECK(names_in(folder.path() / "fields.partial").size() == 6);
  writer.finish();
  CHECK(names_in(folder.path()) == Names{"fields.h5", "fields.xdmf"});
  CHECK(frames_in_xdmf(folder.path()) == 3);
}

TEST_CASE("equal frames give equal bytes") {
  const TemporaryFolder first, second;
  for (const TemporaryFolder* folder : {&first, &second}) {
    FieldWriter writer(folder->path());
    writer.add(a_frame(0, 20000));
    writer.add(a_frame(0.1, 20));
    writer.finish();
  }
  for (const char* name : {"fields.h5", "fields.xdmf"}) {
    CHECK(bytes_of(first.path() / name) == bytes_of(second.path() / name));
  }
}

TEST_CASE("frames that were joined are gone on from, whichever of their parts a kill has left") {
  const TemporaryFolder folder;
  const auto finish_after_two = [&] { FieldWriter(folder.path(), 2).finish(); };
  {
    FieldWriter writer(folder.path());
    writer.add(a_frame(0));
    writer.add(a_frame(0.1));
    writer.finish();
  }
  const auto whole = bytes_of(folder.path() / "fields.h5"), text = bytes_of(folder.path() / "fields.xdmf");
  for (const char* gone : {"frame_0000.h5", "frame_0000.xdmf", "frame_0001.xdmf"}) {
    CAPTURE(gone);
    { const FieldWriter takes_the_parts_again(folder.path(), 2); }
    REQUIRE(fs::remove(folder.path() / "fields.partial" / gone));
    finish_after_two();
    CHECK(bytes_of(folder.path() / "fields.h5") == whole);
    CHECK(bytes_of(folder.path() / "fields.xdmf") == text);
  }
}

TEST_CASE("a frame whose parts do not fit is refused, and nothing of it is written") {
  const TemporaryFolder folder, other;
  FieldWriter writer(folder.path()), expected(other.path());
  const auto refuses = [&](const std::string& words, auto&& spoil) {
    FieldFrame frame = a_frame(0);
    spoil(frame);
    CHECK_THROWS_WITH(writer.add(frame), Catch::Contains(words));
  };
  refuses("place has 6 values, expected 8", [](FieldFrame& frame) { frame.points = 4; });
  refuses("no points", [](FieldFrame& frame) { frame = {0, 2, 0, {}, {}, {}}; });
  refuses("dimension 4", [](FieldFrame& frame) { frame.dim = 4; });
  refuses("u has 5 values, expected 6", [](FieldFrame& frame) { frame.fields[0].values.pop_back(); });
  refuses("material has 2 values, expected 3", [](FieldFrame& frame) { frame.material.pop_back(); });
  refuses("u has 7 components", [](FieldFrame& frame) { frame.fields[0].components = 7; });
  refuses("u has 0 components", [](FieldFrame& frame) { frame.fields[0].components = 0; });
  refuses("'v/x' is no name", [](FieldFrame& frame) { frame.fields[0].name = "v/x"; });
  refuses("'' is no name", [](FieldFrame& frame) { frame.fields[0].name = ""; });
  refuses("more than one 'place'", [](FieldFrame& frame) { frame.fields[0].name = "place"; });
  refuses("more than one 'u'", [](FieldFrame& frame) { frame.fields.push_back(frame.fields[0]); });

  for (FieldWriter* each : {&writer, &expected}) each->add(a_frame(0)), each->finish();
  CHECK(bytes_of(folder.path() / "fields.h5") == bytes_of(other.path() / "fields.h5"));
  CHECK(bytes_of(folder.path() / "fields.xdmf") == bytes_of(other.path() / "fields.xdmf"));
}
