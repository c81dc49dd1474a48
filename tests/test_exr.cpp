// EXR files: bits and attributes survive, other programs' files are read, OpenEXR itself reads ours.
#include <gtest/gtest.h>

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <half.h>

#include <cstring>
#include <limits>

#include "files.h"
#include "random.h"
#include "support.h"

namespace {

// Values that a lossy or half-float path would change.
std::vector<float> hard_pixels(uint32_t width, uint32_t height) {
    test::Random random(29);
    std::vector<float> rgba(std::size_t{4} * width * height);
    for (float &v : rgba) v = static_cast<float>(random.log_uniform(1e-30, 1e30));
    rgba[0] = 0.0f;
    rgba[1] = -1.5f;
    rgba[2] = std::numeric_limits<float>::denorm_min();
    rgba[3] = std::numeric_limits<float>::max();
    return rgba;
}

test::Image make_image(uint32_t width, uint32_t height, const std::vector<float> &rgba) {
    test::Image image;
    EXPECT_SMX_OK(smx_image_create(width, height, rgba.data(), image.out()));
    return image;
}

void expect_bits(smx_image image, uint32_t width, uint32_t height, const std::vector<float> &rgba) {
    const test::Pixels p = test::pixels(image);
    ASSERT_EQ(p.width, width);
    ASSERT_EQ(p.height, height);
    EXPECT_EQ(std::memcmp(p.rgba, rgba.data(), rgba.size() * sizeof(float)), 0);
}

// A file with half-float channels of the given names, every pixel of value 0.5.
void write_foreign(const std::string &path, const std::vector<const char *> &channels) {
    constexpr int width = 5, height = 3;
    const std::vector<half> values(width * height, half(0.5f));
    Imf::Header header(width, height);
    Imf::FrameBuffer buffer;
    for (const char *name : channels) {
        header.channels().insert(name, Imf::Channel(Imf::HALF));
        // OpenEXR's writer takes a mutable pointer but only reads.
        char *base = const_cast<char *>(reinterpret_cast<const char *>(values.data()));
        buffer.insert(name, Imf::Slice(Imf::HALF, base, sizeof(half), width * sizeof(half)));
    }
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(buffer);
    file.writePixels(height);
}

} // namespace

TEST(Exr, BitsSurvive) {
    const test::TempDir dir;
    for (const auto &[width, height] : {std::pair{1u, 1u}, {1u, 7u}, {93u, 93u}, {257u, 89u}}) {
        const std::vector<float> rgba = hard_pixels(width, height);
        const std::string path = dir / "bits.exr";
        ASSERT_SMX_OK(smx_image_write_exr(make_image(width, height, rgba), path.c_str()));
        test::Image back;
        ASSERT_SMX_OK(smx_image_read_exr(path.c_str(), back.out()));
        expect_bits(back, width, height, rgba);
    }
}

TEST(Exr, AttributesSurvive) {
    const test::TempDir dir;
    const test::Image image = make_image(2, 2, hard_pixels(2, 2));
    const std::string longest(255, 'k'), text = "two\nlines, \"quotes\", \xc3\xa9";
    ASSERT_SMX_OK(smx_image_set_attribute(image, "slopemix.note", text.c_str()));
    ASSERT_SMX_OK(smx_image_set_attribute(image, "slopemix.empty", ""));
    ASSERT_SMX_OK(smx_image_set_attribute(image, longest.c_str(), "v"));
    ASSERT_SMX_OK(smx_image_set_attribute(image, "slopemix.note", text.c_str()));
    ASSERT_SMX_OK(smx_image_write_exr(image, (dir / "a.exr").c_str()));
    test::Image back;
    ASSERT_SMX_OK(smx_image_read_exr((dir / "a.exr").c_str(), back.out()));
    EXPECT_STREQ(smx_image_get_attribute(back, "slopemix.note"), text.c_str());
    EXPECT_STREQ(smx_image_get_attribute(back, "slopemix.empty"), "");
    EXPECT_STREQ(smx_image_get_attribute(back, longest.c_str()), "v");
    EXPECT_EQ(smx_image_get_attribute(back, "slopemix.absent"), nullptr);
}

TEST(Exr, OpenExrReadsOurs) {
    const test::TempDir dir;
    const std::vector<float> rgba = hard_pixels(7, 5);
    const test::Image image = make_image(7, 5, rgba);
    ASSERT_SMX_OK(smx_image_set_attribute(image, "slopemix.note", "hello"));
    ASSERT_SMX_OK(smx_image_write_exr(image, (dir / "ours.exr").c_str()));
    Imf::InputFile file((dir / "ours.exr").c_str());
    EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("slopemix.note").value(), "hello");
    Imf::FrameBuffer buffer;
    std::vector<float> back(rgba.size());
    const char *names[] = {"R", "G", "B", "A"};
    for (std::size_t c = 0; c < 4; ++c) {
        ASSERT_NE(file.header().channels().findChannel(names[c]), nullptr) << names[c];
        EXPECT_EQ(file.header().channels().findChannel(names[c])->type, Imf::FLOAT);
        buffer.insert(names[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char *>(back.data() + c), 16, 7 * 16));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(0, 4);
    EXPECT_EQ(std::memcmp(back.data(), rgba.data(), rgba.size() * sizeof(float)), 0);
}

TEST(Exr, ForeignFilesAreRead) {
    const test::TempDir dir;
    write_foreign(dir / "rgb.exr", {"R", "G", "B"});
    write_foreign(dir / "many.exr", {"A", "B", "G", "R", "Z", "albedo.R"});
    for (const char *name : {"rgb.exr", "many.exr"}) {
        test::Image image;
        ASSERT_SMX_OK(smx_image_read_exr((dir / name).c_str(), image.out()));
        const test::Pixels p = test::pixels(image);
        ASSERT_EQ(p.width, 5u);
        ASSERT_EQ(p.height, 3u);
        EXPECT_EQ(p.at(4, 2)[1], 0.5f);
        EXPECT_EQ(p.at(4, 2)[3], std::strcmp(name, "rgb.exr") == 0 ? 1.0f : 0.5f);
    }
}

// Standard errors are read where all three are, with the pixel's own alpha.
TEST(Exr, ErrorsAreReadWhole) {
    const test::TempDir dir;
    write_foreign(dir / "some.exr", {"R", "G", "B", "A", "error.R", "error.G"});
    write_foreign(dir / "all.exr", {"R", "G", "B", "A", "error.R", "error.G", "error.B"});
    test::Image some, all, again;
    ASSERT_SMX_OK(smx_image_read_exr((dir / "some.exr").c_str(), some.out()));
    EXPECT_EQ(smx_image_errors(some), nullptr);
    ASSERT_SMX_OK(smx_image_read_exr((dir / "all.exr").c_str(), all.out()));
    ASSERT_NE(smx_image_errors(all), nullptr);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(smx_image_errors(all)[4 * (5 * 2 + 4) + k], 0.5f);
    ASSERT_SMX_OK(smx_image_write_exr(all, (dir / "again.exr").c_str()));
    ASSERT_SMX_OK(smx_image_read_exr((dir / "again.exr").c_str(), again.out()));
    ASSERT_NE(smx_image_errors(again), nullptr);
    EXPECT_EQ(std::memcmp(smx_image_errors(all), smx_image_errors(again), 15 * 4 * sizeof(float)), 0);
    EXPECT_EQ(smx_image_errors(nullptr), nullptr);
}

TEST(Exr, WrongFilesAreRefused) {
    const test::TempDir dir;
    write_foreign(dir / "no-blue.exr", {"R", "G", "A"});
    test::write_file(dir / "text.exr", "this is no image");
    test::write_file(dir / "empty.exr", "");
    const std::vector<float> rgba = hard_pixels(64, 64);
    ASSERT_SMX_OK(smx_image_write_exr(make_image(64, 64, rgba), (dir / "whole.exr").c_str()));
    const std::string whole = test::read_file(dir / "whole.exr");
    test::write_file(dir / "half.exr", whole.substr(0, whole.size() / 2));
    for (const char *name : {"no-blue.exr", "text.exr", "empty.exr", "half.exr"}) {
        smx_image image = nullptr;
        EXPECT_SMX_FAILS(SMX_BAD_FORMAT, name, smx_image_read_exr((dir / name).c_str(), &image));
        EXPECT_EQ(image, nullptr);
    }
    smx_image image = nullptr;
    EXPECT_SMX_FAILS(SMX_CANNOT_READ, "absent.exr", smx_image_read_exr((dir / "absent.exr").c_str(), &image));
}

// OpenEXR would go on reading where the value ends by its type, and take what stands there for sizes to allocate.
TEST(Exr, AttributesOfAnotherSizeThanTheirTypesAreRefused) {
    const test::TempDir dir;
    const std::string file = dir / "image.exr";
    ASSERT_SMX_OK(smx_image_write_exr(make_image(64, 64, hard_pixels(64, 64)), file.c_str()));
    const std::string whole = test::read_file(file);
    for (const std::string type : {"chlist", "box2i", "v2f", "float"}) {
        std::string bytes = whole;
        const std::size_t size = whole.find(type + '\0') + type.size() + 1;
        ++bytes[size];
        test::write_file(file, bytes);
        smx_image image = nullptr;
        EXPECT_SMX_FAILS(SMX_BAD_FORMAT, "is no " + type, smx_image_read_exr(file.c_str(), &image));
    }
}

TEST(Exr, FailedWritesLoseNothing) {
    const test::TempDir dir;
    const test::Image image = make_image(64, 64, hard_pixels(64, 64));
    for (const char *name : {"kept.exr", "kept.png"}) test::write_file(dir / name, "precious");
    {
        const test::FileSizeLimit full(256);
        EXPECT_SMX_FAILS(SMX_CANNOT_WRITE, "kept.exr", smx_image_write_exr(image, (dir / "kept.exr").c_str()));
        EXPECT_SMX_FAILS(SMX_CANNOT_WRITE, "kept.png", smx_image_write_png(image, (dir / "kept.png").c_str(), 1.0));
    }
    EXPECT_EQ(test::read_file(dir / "kept.exr"), "precious");
    EXPECT_EQ(test::read_file(dir / "kept.png"), "precious");
    EXPECT_SMX_FAILS(SMX_CANNOT_WRITE, "absent", smx_image_write_exr(image, (dir / "absent/a.exr").c_str()));
    EXPECT_SMX_FAILS(SMX_CANNOT_WRITE, "absent", smx_image_write_png(image, (dir / "absent/a.png").c_str(), 1.0));
    EXPECT_EQ(dir.names(), (std::vector<std::string>{"kept.exr", "kept.png"}));
}

// A disk may be full at the last byte: what waits in a buffer, and the offsets that go to the head at the end.
TEST(Exr, ADiskThatIsFullAtTheLastByteIsNoticed) {
    const test::TempDir dir;
    const std::string path = dir / "kept.exr";
    for (const uint32_t side : {2u, 64u}) {
        const test::Image image = make_image(side, side, hard_pixels(side, side));
        ASSERT_SMX_OK(smx_image_write_exr(image, path.c_str()));
        const std::string whole = test::read_file(path);
        for (const std::size_t size : {whole.size() - 1, whole.size() / 2, std::size_t{1}}) {
            const test::FileSizeLimit full(size);
            EXPECT_SMX_FAILS(SMX_CANNOT_WRITE, "kept.exr", smx_image_write_exr(image, path.c_str())) << size;
        }
        EXPECT_TRUE(test::read_file(path) == whole);
        EXPECT_EQ(dir.names(), std::vector<std::string>{"kept.exr"});
    }
}
