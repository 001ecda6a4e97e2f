// SPDX-License-Identifier: Apache-2.0
#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <stdexcept>

#include "studio/errors.h"
#include "studio/image/atomic_file.h"
#include "studio/image/image_io.h"

namespace penumbra::studio {
namespace {

constexpr std::int64_t maxPixels = std::int64_t(1) << 27;
constexpr std::array<std::string_view, 4> colorNames{"R", "G", "B", "A"};

/// Encoding in memory leaves everything that can go wrong with disks to writeFileAtomically().
class MemoryOutput : public Imf::OStream {
  public:
    MemoryOutput() : OStream("memory") {}
    void write(const char data[], int size) override {
        bytes_.resize(std::max(bytes_.size(), position_ + std::size_t(size)));
        std::memcpy(bytes_.data() + position_, data, std::size_t(size));
        position_ += std::size_t(size);
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }
    std::span<const std::byte> bytes() const { return bytes_; }

  private:
    std::vector<std::byte> bytes_;
    std::size_t position_ = 0;
};

class MemoryInput : public Imf::IStream {
  public:
    explicit MemoryInput(std::span<const std::byte> bytes) : IStream("memory"), bytes_(bytes) {}
    bool read(char destination[], int size) override {
        if (size < 0 || position_ > bytes_.size() || bytes_.size() - position_ < std::size_t(size)) {
            throw std::runtime_error("the file ends too early");
        }
        std::memcpy(destination, bytes_.data() + position_, std::size_t(size));
        position_ += std::size_t(size);
        return position_ < bytes_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

  private:
    std::span<const std::byte> bytes_;
    std::size_t position_ = 0;
};

std::string colorChannelName(std::string_view name, std::string_view color) {
    return name.empty() ? std::string(color) : fmt::format("{}.{}", name, color);
}

std::vector<std::byte> encode(const ExrPicture& picture) {
    Imf::Header header(picture.width_px, picture.height_px);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer frameBuffer;
    for (const ExrChannel& channel : picture.channels) {
        assert(channel.values.size() == std::size_t(picture.width_px) * picture.height_px);
        header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
        // OpenEXR reads and writes frame buffers through one type, hence the cast; nothing is written here.
        char* base = const_cast<char*>(reinterpret_cast<const char*>(channel.values.data()));
        frameBuffer.insert(channel.name,
                           Imf::Slice(Imf::FLOAT, base, sizeof(float), sizeof(float) * picture.width_px));
    }
    for (const auto& [key, value] : picture.metadata) {
        if (header.find(key) != header.end())
            throw std::runtime_error(fmt::format("'{}' is a reserved name", key));
        header.insert(key, Imf::StringAttribute(value));
    }
    MemoryOutput output;
    {
        Imf::OutputFile file(output, header, 0);
        file.setFrameBuffer(frameBuffer);
        file.writePixels(picture.height_px);
    }
    return {output.bytes().begin(), output.bytes().end()};
}

ExrPicture decode(std::span<const std::byte> bytes) {
    MemoryInput input(bytes);
    Imf::InputFile file(input, 0);
    const Imf::Header& header = file.header();
    const Imath::Box2i window = header.dataWindow();
    const std::int64_t width = std::int64_t(window.max.x) - window.min.x + 1;
    const std::int64_t height = std::int64_t(window.max.y) - window.min.y + 1;
    if (width < 1 || height < 1 || width > maxPixels / height)
        throw std::runtime_error("its size is not supported");

    ExrPicture picture{.width_px = int(width), .height_px = int(height)};
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) {
            throw std::runtime_error(fmt::format("its channel '{}' is sub-sampled", channel.name()));
        }
        if (std::int64_t(picture.channels.size() + 1) * width * height > 4 * maxPixels) {
            throw std::runtime_error("it has too many channels");
        }
        picture.channels.push_back({channel.name(), std::vector<float>(std::size_t(width * height))});
    }
    Imf::FrameBuffer frameBuffer;
    for (ExrChannel& channel : picture.channels) {
        frameBuffer.insert(channel.name, Imf::Slice::Make(Imf::FLOAT, channel.values.data(), window));
    }
    file.setFrameBuffer(frameBuffer);
    file.readPixels(window.min.y, window.max.y);

    for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute())) {
            picture.metadata[attribute.name()] = text->value();
        }
    }
    return picture;
}

}  // namespace

std::vector<ExrChannel> channelsOf(const Image& image, std::string_view name) {
    std::vector<ExrChannel> channels(std::size_t(image.channels));
    for (int c = 0; c < image.channels; ++c) {
        ExrChannel& channel = channels[std::size_t(c)];
        channel.name =
            image.channels == 1 ? std::string(name) : colorChannelName(name, colorNames.at(std::size_t(c)));
        channel.values.resize(image.pixelCount());
        for (std::size_t i = 0; i < image.pixelCount(); ++i)
            channel.values[i] = image.values[i * image.channels + c];
    }
    return channels;
}

Image imageOf(const ExrPicture& picture, std::string_view name) {
    const auto find = [&](std::string_view wanted) -> const ExrChannel* {
        const auto found = std::ranges::find(picture.channels, wanted, &ExrChannel::name);
        return found == picture.channels.end() ? nullptr : &*found;
    };
    std::vector<const ExrChannel*> sources;
    if (const ExrChannel* only = find(name)) {
        sources = {only};
    } else {
        for (std::string_view color : colorNames) sources.push_back(find(colorChannelName(name, color)));
        if (!sources.back()) sources.pop_back();
    }
    if (std::ranges::count(sources, nullptr) > 0) {
        throw InputError(fmt::format("the EXR picture has no channel '{0}' and no '{1}', '{2}', '{3}'", name,
                                     colorChannelName(name, "R"), colorChannelName(name, "G"),
                                     colorChannelName(name, "B")));
    }
    Image image(picture.width_px, picture.height_px, int(sources.size()));
    for (std::size_t c = 0; c < sources.size(); ++c) {
        for (std::size_t i = 0; i < image.pixelCount(); ++i) {
            image.values[i * sources.size() + c] = sources[c]->values[i];
        }
    }
    return image;
}

void writeExr(const std::filesystem::path& path, const ExrPicture& picture) {
    std::vector<std::byte> bytes;
    try {
        bytes = encode(picture);
    } catch (const std::exception& error) {
        throw OutputError(
            fmt::format("cannot write '{}': {}; choose another size, channel name or metadata key",
                        path.string(), error.what()));
    }
    writeFileAtomically(path, bytes);
}

ExrPicture readExr(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = readWholeFile(path);
    try {
        return decode(bytes);
    } catch (const std::exception& error) {
        throw InputError(fmt::format("cannot read '{}' as an EXR picture: {}; write it again", path.string(),
                                     error.what()));
    }
}

}  // namespace penumbra::studio
