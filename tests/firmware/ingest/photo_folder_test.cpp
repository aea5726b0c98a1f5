// SPDX-License-Identifier: MIT
#include "firmware/ingest/photo_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "firmware/ingest/file_hash.h"
#include "firmware/ingest/photo_files.h"
#include "tests/firmware/ingest/tagged_photo.h"
#include "tests/firmware/ingest/temporary_folder.h"

namespace plumbline::ingest {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::uint8_t> photo(unsigned seed, int width_px = 64) {
  PhotoContent content;
  content.seed = seed;
  content.width_px = width_px;
  content.exif = exif_position();
  return tagged_photo(content);
}

Result<PhotoSet> read(const std::vector<fs::path>& paths) { return read_photos(paths, 2, nullptr); }

std::string fault(const std::vector<fs::path>& paths) {
  const auto set = read(paths);
  return set.ok() ? "" : set.error().sentence;
}

std::vector<std::string> names(const PhotoSet& set) {
  std::vector<std::string> result;
  for (const PhotoRecord& record : set.photos) result.push_back(record.name);
  return result;
}

// FIPS 180-4, example "abc".
TEST(Sha256, IsThatOfTheStandard) {
  const std::string text = "abc";
  EXPECT_EQ(sha256_hex({reinterpret_cast<const std::uint8_t*>(text.data()), 3}),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(NaturalOrder, CountsDigitsByTheirValue) {
  EXPECT_TRUE(natural_less("IMG_9.jpg", "IMG_10.jpg"));
  EXPECT_FALSE(natural_less("IMG_10.jpg", "IMG_9.jpg"));
  EXPECT_TRUE(natural_less("a2b10", "a2b11"));
  EXPECT_TRUE(natural_less("7", "07") != natural_less("07", "7"));
  EXPECT_FALSE(natural_less("a", "a"));
  EXPECT_TRUE(natural_less("a", "a1"));
}

TEST(PhotoFolder, IsReadInTheOrderOfItsNames) {
  const TemporaryFolder folder;
  folder.write("IMG_10.JPG", photo(1));
  folder.write("IMG_9.jpeg", photo(2));
  folder.write("IMG_100.jpg", photo(3));
  folder.write(".hidden.jpg", std::string("x"));
  folder.write("notes.txt", std::string("x"));
  const auto set = read({folder.path()});
  ASSERT_TRUE(set.ok()) << set.error().sentence;
  EXPECT_THAT(names(*set), ElementsAre("IMG_9.jpeg", "IMG_10.JPG", "IMG_100.jpg"));
  EXPECT_EQ(set->photos_given, 3);
  EXPECT_THAT(set->warnings, ElementsAre(HasSubstr("'notes.txt'")));
  EXPECT_TRUE(set->photos[0].position);
  EXPECT_EQ(set->photos[0].sha256, sha256_hex(photo(2)));
  const auto image = load_grey(set->photos[1]);
  ASSERT_TRUE(image.ok());
  EXPECT_EQ(image->width_px, 64);
}

TEST(PhotoFolder, MayBeAFlight) {
  const TemporaryFolder folder;
  folder.write("flight/photos/0001.jpg", photo(1));
  folder.write("flight/photos/0002.jpg", photo(2));
  folder.write("flight/camera.toml", std::string("x"));
  folder.write("flight/result/other.jpg", photo(3));
  const auto set = read({folder / "flight"});
  ASSERT_TRUE(set.ok());
  EXPECT_THAT(names(*set), ElementsAre("0001.jpg", "0002.jpg"));
  EXPECT_EQ(set->camera_toml, folder / "flight/camera.toml");
  EXPECT_THAT(set->warnings, IsEmpty());
}

TEST(PhotoFolder, IsMeasuredWithoutItsTruncatedPhotoAndSaysSo) {
  const TemporaryFolder folder;
  auto cut = photo(3);
  cut.resize(cut.size() * 2 / 3);
  folder.write("a.jpg", photo(1));
  folder.write("b.jpg", cut);
  folder.write("c.jpg", photo(2));
  folder.write("d.jpg", std::string("not a photo at all"));
  const auto set = read({folder.path()});
  ASSERT_TRUE(set.ok());
  EXPECT_THAT(names(*set), ElementsAre("a.jpg", "c.jpg"));
  EXPECT_EQ(set->photos_given, 4);
  EXPECT_THAT(set->warnings, ElementsAre(HasSubstr("'b.jpg' is damaged or cut short"),
                                         HasSubstr("'d.jpg' is not a JPEG photo")));
}

TEST(PhotoFolder, KeepsOneOfTwoExactCopies) {
  const TemporaryFolder folder;
  folder.write("a.jpg", photo(1));
  folder.write("b.jpg", photo(1));
  EXPECT_THAT(fault({folder.path()}), HasSubstr("only one usable photo, 'a.jpg'"));
  folder.write("c.jpg", photo(2));
  const auto set = read({folder.path()});
  ASSERT_TRUE(set.ok());
  EXPECT_THAT(names(*set), ElementsAre("a.jpg", "c.jpg"));
  EXPECT_THAT(set->warnings, ElementsAre(HasSubstr("'b.jpg' is an exact copy of 'a.jpg'")));
}

TEST(PhotoFolder, SaysInOneSentenceWhyItCannotBeUsed) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "empty");
  EXPECT_THAT(fault({folder / "empty"}), HasSubstr("no JPEG photos in"));
  EXPECT_THAT(fault({folder / "missing"}), HasSubstr("no file or folder"));
  EXPECT_THAT(fault({}), HasSubstr("no JPEG photos"));
  folder.write("one/a.jpg", photo(1));
  EXPECT_THAT(fault({folder / "one"}), HasSubstr("only one usable photo"));
  folder.write("text/a.jpg", std::string("hello"));
  folder.write("text/b.jpg", std::string("hallo"));
  EXPECT_THAT(fault({folder / "text"}), HasSubstr("no usable photo"));
}

TEST(PhotoFolder, NamesThePhotosOfAnotherSize) {
  const TemporaryFolder folder;
  folder.write("a.jpg", photo(1));
  folder.write("b.jpg", photo(2, 80));
  folder.write("c.jpg", photo(3));
  const std::string sentence = fault({folder.path()});
  EXPECT_THAT(sentence, HasSubstr("'b.jpg' has 80 x 48"));
  EXPECT_THAT(sentence, HasSubstr("others 64 x 48"));
}

TEST(PhotoFolder, TellsPhotosOfOneNameInTwoFoldersApart) {
  const TemporaryFolder folder;
  folder.write("x/1.jpg", photo(1));
  folder.write("y/1.jpg", photo(2));
  const auto set = read({folder / "x", folder / "y"});
  ASSERT_TRUE(set.ok());
  EXPECT_THAT(names(*set), ElementsAre("x/1.jpg", "y/1.jpg"));
}

TEST(PhotoFolder, GivesTheSameForOneThreadAndForTwo) {
  const TemporaryFolder folder;
  for (unsigned i = 0; i < 12; ++i) folder.write(std::to_string(i) + ".jpg", photo(i));
  const auto one = read_photos({folder.path()}, 1, nullptr);
  const auto two = read_photos({folder.path()}, 2, nullptr);
  ASSERT_TRUE(one.ok() && two.ok());
  EXPECT_EQ(names(*one), names(*two));
  EXPECT_EQ(one->warnings, two->warnings);
}

TEST(PhotoFolder, NoticesAPhotoThatChangedMeanwhile) {
  const TemporaryFolder folder;
  folder.write("a.jpg", photo(1));
  folder.write("b.jpg", photo(2));
  const auto set = read({folder.path()});
  folder.write("a.jpg", photo(9, 72));
  const auto image = load_grey(set->photos[0]);
  ASSERT_FALSE(image.ok());
  EXPECT_THAT(image.error().sentence, HasSubstr("has changed"));
}

}  // namespace
}  // namespace plumbline::ingest
