#include "tests/fuzz/made_files.h"

#include <tiffio.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>

namespace fuzz {

namespace {

constexpr int width = 9, height = 7, tileSide = 16;

// ------------------------------------------------------------------ TIFF

struct TiffForm {
    const char* mode = "w";  ///< "wb": the highest byte first; "w8": BigTIFF
    int bits = 8, samples = 1, compression = COMPRESSION_NONE, predictor = PREDICTOR_NONE, rowsPerStrip = height;
    bool isTiled = false, isPlanar = false;
};

/// Numbers of the form's kind.
std::string pixels(const TiffForm& form, std::size_t count)
{
    std::string bytes;
    for (std::size_t i = 0; i < count; ++i) {
        if (form.bits == 32) {
            const float value = static_cast<float>(i % 5) / 4;
            char number[sizeof value];
            std::memcpy(number, &value, sizeof value);
            bytes.append(number, sizeof value);
        } else {
            bytes += little(static_cast<std::uint32_t>(i * 7), form.bits / 8);
        }
    }
    return bytes;
}

void describe(TIFF* tiff, const TiffForm& form)
{
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, height);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, form.bits);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, form.samples);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, form.bits == 32 ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, form.samples < 3 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, form.isPlanar ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
    if (form.samples == 2 || form.samples == 4) {
        const std::uint16_t alpha = EXTRASAMPLE_UNASSALPHA;
        TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &alpha);
    }
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, form.compression);
    if (form.predictor != PREDICTOR_NONE) TIFFSetField(tiff, TIFFTAG_PREDICTOR, form.predictor);
    if (form.isTiled) {
        TIFFSetField(tiff, TIFFTAG_TILEWIDTH, tileSide);
        TIFFSetField(tiff, TIFFTAG_TILELENGTH, tileSide);
    } else {
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, form.rowsPerStrip);
    }
}

/// Writing with a predictor changes the numbers that it gets, so each call has its own.
bool writePixels(TIFF* tiff, const TiffForm& form)
{
    const int planes = form.isPlanar ? form.samples : 1;
    const auto together = static_cast<std::size_t>(form.isPlanar ? 1 : form.samples);
    for (int plane = 0; plane < planes; ++plane) {
        if (form.isTiled) {
            std::string tile = pixels(form, std::size_t{tileSide} * tileSide * together);
            if (TIFFWriteEncodedTile(tiff, static_cast<std::uint32_t>(plane), tile.data(), static_cast<tmsize_t>(tile.size())) <
                0)
                return false;
            continue;
        }
        for (int row = 0; row < height; ++row) {
            std::string line = pixels(form, std::size_t{width} * together);
            if (TIFFWriteScanline(tiff, line.data(), static_cast<std::uint32_t>(row), static_cast<std::uint16_t>(plane)) < 0)
                return false;
        }
    }
    return true;
}

/// Empty where libtiff cannot write the form.
std::string tiffOf(const TiffForm& form, const std::filesystem::path& scratch)
{
    {
        const std::unique_ptr<TIFF, decltype(&TIFFClose)> tiff(TIFFOpen(scratch.c_str(), form.mode), TIFFClose);
        if (!tiff) return {};
        describe(tiff.get(), form);
        if (!writePixels(tiff.get(), form)) return {};
    }
    std::ifstream in(scratch, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> tiffsOf(const std::vector<TiffForm>& forms, const std::filesystem::path& scratch)
{
    std::vector<std::string> files;
    for (const TiffForm& form : forms)
        if (std::string file = tiffOf(form, scratch); !file.empty()) files.push_back(std::move(file));
    return files;
}

/// Each compression with each predictor that it knows, then the other layouts.
std::vector<TiffForm> formsOf(int bits, int samples)
{
    const TiffForm plain{.bits = bits, .samples = samples};
    std::vector<TiffForm> forms(7, plain);
    forms[1].mode = "wb";
    forms[2].mode = "w8";
    forms[3].rowsPerStrip = 1;
    forms[4].isTiled = true;
    forms[5].isPlanar = samples > 1;
    forms[6].compression = COMPRESSION_PACKBITS;
    const int predictor = bits == 32 ? PREDICTOR_FLOATINGPOINT : PREDICTOR_HORIZONTAL;
    for (const int compression : {COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE})
        for (const int one : {PREDICTOR_NONE, predictor})
            for (const char* mode : {"w", "wb"}) {
                TiffForm form = plain;
                form.mode = mode;
                form.compression = compression;
                form.predictor = one;
                form.rowsPerStrip = 2;
                forms.push_back(form);
            }
    return forms;
}

// ------------------------------------------------------------------ BMP and GIF

struct BmpForm {
    std::uint32_t header = 40, bits = 24, compression = 0;
    bool isTopDown = false;
};

std::string bmpOf(const BmpForm& form, const std::string& coded = {})
{
    constexpr std::uint32_t shortHeader = 12, fileHeader = 14, masks = 3;
    const bool isShort = form.header == shortHeader;
    std::string palette;
    if (form.bits <= 8)
        for (std::uint32_t i = 0; i < 1U << form.bits; ++i) palette += little(i * 0x010203, isShort ? 3 : 4);
    if (form.compression == masks)
        for (const std::uint32_t mask : {0xF800U, 0x07E0U, 0x001FU}) palette += little(mask, 4);
    std::string rows = coded;
    const std::uint32_t rowBytes = (width * form.bits + 31) / 32 * 4;
    if (rows.empty())
        for (std::uint32_t i = 0; i < rowBytes * height; ++i) rows += static_cast<char>(i * 5);
    std::string header = little(form.header, 4);
    const auto stated = static_cast<std::uint32_t>(form.isTopDown ? -height : height);
    if (isShort) {
        header += little(width, 2) + little(height, 2) + little(1, 2) + little(form.bits, 2);
    } else {
        header += little(width, 4) + little(stated, 4) + little(1, 2) + little(form.bits, 2) + little(form.compression, 4) +
                  little(static_cast<std::uint32_t>(rows.size()), 4) + little(5906, 4) + little(5906, 4) + little(0, 8);
        header.resize(form.header, '\0');
    }
    const auto start = static_cast<std::uint32_t>(fileHeader + header.size() + palette.size());
    return "BM" + little(start + static_cast<std::uint32_t>(rows.size()), 4) + little(0, 4) + little(start, 4) + header +
           palette + rows;
}

/// Runs, literal pixels, the ends of rows and the end of the picture.
std::string runLengthCoded()
{
    std::string rows;
    for (int row = 0; row < height; ++row) rows += std::string("\5\7\0\4\1\2\3\4\0\0", 10);
    return rows + std::string("\0\1", 2);
}

// ------------------------------------------------------------------ WAV

std::string chunkOf(const std::string& name, const std::string& body)
{
    return name + little(static_cast<std::uint32_t>(body.size()), 4) + body + (body.size() % 2 == 1 ? std::string(1, '\0') : "");
}

std::string wavFile(std::uint32_t channels, std::uint32_t rateHz, bool isExtensible, const std::string& before = {})
{
    std::string format = little(isExtensible ? 0xFFFE : 1, 2) + little(channels, 2) + little(rateHz, 4) +
                         little(rateHz * channels * 2, 4) + little(channels * 2, 2) + little(16, 2);
    if (isExtensible) format += little(22, 2) + little(16, 2) + little(3, 4) + little(1, 2) + std::string(14, '\x10');
    std::string samples;
    for (std::uint32_t i = 0; i < 60 * channels; ++i) samples += little(i * 1021, 2);
    const std::string chunks = "WAVE" + chunkOf("fmt ", format) + before + chunkOf("data", samples);
    return "RIFF" + little(static_cast<std::uint32_t>(chunks.size()), 4) + chunks;
}

}  // namespace

std::string little(std::uint32_t value, int size)
{
    std::string bytes;
    for (int i = 0; i < size; ++i) bytes += i < 4 ? static_cast<char>(value >> 8 * i & 0xff) : '\0';
    return bytes;
}

std::vector<std::string> greyTiffs(const std::filesystem::path& scratch)
{
    std::vector<TiffForm> forms;
    for (const int bits : {8, 16, 32})
        for (const TiffForm& form : formsOf(bits, 1)) forms.push_back(form);
    return tiffsOf(forms, scratch);
}

std::vector<std::string> colourTiffs(const std::filesystem::path& scratch)
{
    std::vector<TiffForm> forms;
    for (const int samples : {3, 4, 1, 2})
        for (const int bits : {8, 16})
            for (const TiffForm& form : formsOf(bits, samples)) forms.push_back(form);
    return tiffsOf(forms, scratch);
}

std::vector<std::string> drawnPictures()
{
    const std::string gif("GIF89a\1\0\1\0\x80\0\0\xFF\xFF\xFF\0\0\0,\0\0\0\0\1\0\1\0\0\2\2\x44\1\0;", 35);
    std::vector<std::string> pictures{gif, bmpOf({.bits = 8, .compression = 1}, runLengthCoded()),
                                      bmpOf({.bits = 4, .compression = 2}, runLengthCoded()),
                                      bmpOf({.bits = 16, .compression = 3}), bmpOf({.isTopDown = true})};
    for (const std::uint32_t bits : {1U, 4U, 8U, 16U, 24U, 32U}) pictures.push_back(bmpOf({.bits = bits}));
    for (const std::uint32_t header : {12U, 64U, 108U, 124U}) pictures.push_back(bmpOf({.header = header}));
    pictures.push_back(bmpOf({.header = 12, .bits = 4}));
    return pictures;
}

std::vector<std::string> recordings()
{
    std::vector<std::string> files;
    for (const std::uint32_t rateHz : {8000U, 44100U, 48000U, 192000U})
        for (const std::uint32_t channels : {1U, 2U}) files.push_back(wavFile(channels, rateHz, rateHz == 44100));
    files.push_back(wavFile(1, 48000, false, chunkOf("LIST", "INFOabc")));
    return files;
}

}  // namespace fuzz
