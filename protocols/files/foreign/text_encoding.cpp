#include "protocols/files/foreign/text_encoding.h"

#include <iconv.h>

#include <algorithm>
#include <cerrno>
#include <optional>

#include "protocols/files/errors.h"
#include "protocols/files/utf8.h"

namespace protocols {

namespace {

struct ByteOrderMark {
    std::string_view bytes;
    const char* iconvName;
    const char* name;
};

constexpr ByteOrderMark byteOrderMarks[] = {
    {"\xEF\xBB\xBF", "UTF-8", "UTF-8"}, {"\xFF\xFE", "UTF-16LE", "UTF-16"}, {"\xFE\xFF", "UTF-16BE", "UTF-16"}};

/// A converter of iconv, closed at the end of its scope.
class Converter {
public:
    explicit Converter(const std::string& encoding) : m_handle(iconv_open("UTF-8", encoding.c_str())) {}
    ~Converter()
    {
        if (exists()) iconv_close(m_handle);
    }
    Converter(const Converter&) = delete;
    Converter& operator=(const Converter&) = delete;

    // iconv_open returns -1 as a pointer where it does not know the name.
    bool exists() const { return m_handle != reinterpret_cast<iconv_t>(-1); }  // NOLINT(performance-no-int-to-ptr)

    /// The text; nullopt and the offset of the first byte without meaning in `fault`.
    std::optional<std::string> convert(std::string_view bytes, std::size_t& fault)
    {
        std::string text(4 * bytes.size() + 4, '\0');  // No character of these encodings takes more than 4 bytes of UTF-8 a byte.
        char* in = const_cast<char*>(bytes.data());    // iconv does not write to it.
        char* out = text.data();
        std::size_t inLeft = bytes.size(), outLeft = text.size();
        constexpr auto failed = static_cast<std::size_t>(-1);
        // The second call writes the last letter, which some encodings (CP1258, CP1255) hold back for a mark that may follow.
        if (iconv(m_handle, &in, &inLeft, &out, &outLeft) == failed ||
            iconv(m_handle, nullptr, nullptr, &out, &outLeft) == failed) {
            fault = bytes.size() - inLeft;
            return std::nullopt;
        }
        text.resize(text.size() - outLeft);
        return text;
    }

private:
    iconv_t m_handle;
};

bool isHigh(char c) { return (static_cast<unsigned char>(c) & 0x80U) != 0; }

/// Bytes above 127 stand in runs of even length, each byte at least 0xA1: the characters of GB 2312, a part of GB18030. At least
/// half of them are of its first level, the common ones. Accented letters of a European text stand alone or beside ASCII; two in
/// a row, as in "Größe", would be a rare character.
bool isPairedAsChinese(std::string_view bytes)
{
    std::size_t common = 0, rare = 0;
    for (std::size_t at = 0; at < bytes.size();) {
        std::size_t run = 0;
        for (; at < bytes.size() && isHigh(bytes[at]); ++at, ++run)
            if (static_cast<unsigned char>(bytes[at]) < 0xA1) return false;
        if (run % 2 == 1) return false;
        for (std::size_t lead = at - run; lead < at; lead += 2) {
            const auto first = static_cast<unsigned char>(bytes[lead]);
            common += first >= 0xB0 && first <= 0xD7 ? 1 : 0;
            rare += first > 0xD7 ? 1 : 0;
        }
        at += run == 0 ? 1 : 0;
    }
    return common >= rare;
}

bool endsLinesByReturnAlone(std::string_view bytes)
{
    return bytes.find('\n') == std::string_view::npos && bytes.find('\r') != std::string_view::npos;
}

std::string nameFor(const std::string& encoding)
{
    return encoding == "CP1252" ? "Windows-1252" : encoding == "MACINTOSH" ? "Mac OS Roman" : encoding;
}

std::string converted(std::string_view bytes, const std::string& where, const std::string& encoding)
{
    Converter converter(encoding);
    if (!converter.exists())
        throw badInput({"the encoding \"" + encoding + "\" is unknown here", where, "a name that `iconv -l` lists",
                        "save the file as UTF-8, or name its encoding"});
    std::size_t fault = 0;
    if (auto text = converter.convert(bytes, fault)) return *std::move(text);
    throw badInput({"byte " + std::to_string(fault + 1) + " has no meaning in " + nameFor(encoding), where, "text",
                    "save the file as UTF-8, or name its encoding with --encoding"});
}

}  // namespace

DecodedText decodedText(std::string_view bytes, const std::string& where)
{
    for (const ByteOrderMark& mark : byteOrderMarks)
        if (bytes.starts_with(mark.bytes)) return {converted(bytes.substr(mark.bytes.size()), where, mark.iconvName), mark.name};
    if (!firstByteThatIsNotUtf8(bytes)) return {std::string(bytes), "UTF-8"};
    const std::string encoding = isPairedAsChinese(bytes) ? "GB18030" : endsLinesByReturnAlone(bytes) ? "MACINTOSH" : "CP1252";
    return {converted(bytes, where, encoding), nameFor(encoding)};
}

DecodedText decodedText(std::string_view bytes, const std::string& where, const std::string& encoding)
{
    return {converted(bytes, where, encoding), encoding};
}

}  // namespace protocols
