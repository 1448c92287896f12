// Image files are read back bit for bit. Damaged files are refused by name.
#include "rendering/images/image_io.h"

#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <new>
#include <string>

#include "protocols/files/whole_file.h"
#include "tests/rendering/fabric_files.h"

using namespace fabric_files;
using namespace rendering;

// Memory that ends: the linker prefers these to those of the C++ library.
static std::size_t largestAllocation = std::numeric_limits<std::size_t>::max();

void* operator new(std::size_t bytes)
{
    void* memory = bytes <= largestAllocation ? std::malloc(bytes) : nullptr;
    if (!memory) throw std::bad_alloc();
    return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace {

bool sameBits(const cv::Mat& a, const cv::Mat& b)
{
    if (a.size() != b.size() || a.type() != b.type()) return false;
    for (int row = 0; row < a.rows; ++row)
        if (std::memcmp(a.ptr(row), b.ptr(row), std::size_t(a.cols) * a.elemSize()) != 0) return false;
    return true;
}

cv::Mat wavyHeight(int rows, int columns)
{
    cv::Mat_<float> height(rows, columns);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) height(y, x) = 0.3f + 0.2f * std::sin(0.3f * float(x)) * std::cos(0.2f * float(y));
    return height;
}

QByteArray bigEndian(std::uint32_t value)
{
    QByteArray bytes(4, '\0');
    for (int i = 0; i < 4; ++i) bytes[i] = static_cast<char>(value >> (24 - 8 * i));
    return bytes;
}

/// Checksum of a chunk (PNG specification, annex D).
std::uint32_t crcOf(const QByteArray& chunk)
{
    std::uint32_t crc = ~0U;
    for (const char byte : chunk) {
        crc ^= static_cast<std::uint8_t>(byte);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    return ~crc;
}

QByteArray chunkOf(const QByteArray& name, const QByteArray& body)
{
    return bigEndian(static_cast<std::uint32_t>(body.size())) + name + body + bigEndian(crcOf(name + body));
}

QByteArray deflated(const QByteArray& bytes) { return qCompress(bytes, 9).mid(4); }  // Qt puts the length in front.

enum PngColours { Grey = 0, Rgb = 2, Palette = 3 };

/// A PNG with `between` before its rows. Each row of `rows` begins with the byte of its filter.
std::string pngOf(cv::Size size, int bits, PngColours colours, const QByteArray& between, const QByteArray& rows)
{
    const QByteArray header = bigEndian(std::uint32_t(size.width)) + bigEndian(std::uint32_t(size.height)) + char(bits) +
                              char(colours) + QByteArray(3, '\0');
    return (QByteArray("\x89PNG\r\n\x1a\n", 8) + chunkOf("IHDR", header) + between + chunkOf("IDAT", deflated(rows)) +
            chunkOf("IEND", {}))
        .toStdString();
}

/// Two grey pixels, 10 and 200, side by side and uncompressed.
std::string greyTiff(quint32 kind, quint32 orientation)
{
    constexpr quint32 shortest = 3, longest = 4, pixels = 10 + 10 * 12 + 4;
    const quint32 entries[][3] = {{256, longest, 2},     {257, longest, 1},      {258, shortest, 8},           {259, shortest, 1},
                                  {262, shortest, kind}, {273, longest, pixels}, {274, shortest, orientation}, {277, shortest, 1},
                                  {278, longest, 1},     {279, longest, 2}};
    QByteArray tiff("II*\0\x08\0\0\0\x0a\0", 10);
    for (const auto& [tag, type, value] : entries) {
        const quint32 words[] = {tag | type << 16, 1, value};
        tiff += QByteArray(reinterpret_cast<const char*>(words), sizeof words);
    }
    return (tiff + QByteArray(4, '\0') + "\x0a\xc8").toStdString();
}

/// Most memory that this process has held, MB.
double mostMemoryMb()
{
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024;
    return 0;
}

}  // namespace

class ImageIoTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void pngComesBackBitForBit_data()
    {
        QTest::addColumn<int>("type");
        QTest::newRow("8-bit grey") << int(CV_8UC1);
        QTest::newRow("8-bit colour") << int(CV_8UC3);
        QTest::newRow("16-bit grey") << int(CV_16UC1);
        QTest::newRow("16-bit colour") << int(CV_16UC3);
    }

    void pngComesBackBitForBit()
    {
        QFETCH(int, type);
        const cv::Mat image = speckled(33, 47, type);
        const fs::path file = pathOf(m_folder) / "picture.png";
        writePng(file, image);
        QVERIFY(sameBits(readPng(file), image));
        QVERIFY(sameBits(readImage(file), image));
    }

    void pngKeepsRedFirst()
    {
        const fs::path file = pathOf(m_folder) / "red.png";
        writePng(file, cv::Mat(2, 2, CV_8UC3, cv::Scalar(200, 10, 30)));
        QCOMPARE(int(readPng(file).at<cv::Vec3b>(0, 0)[0]), 200);
        QCOMPARE(int(readPng(file).at<cv::Vec3b>(0, 0)[2]), 30);
    }

    /// A phone writes 6 where it was held upright. Programs that convert its JPEG to PNG keep the mark.
    void pngIsTurnedAsItsMarkSays_data()
    {
        // Grey values by rows: as stored, they are 10, 20 and 30, 40.
        QTest::addColumn<int>("mark");
        QTest::addColumn<QByteArray>("shown");
        const char* rows[] = {"\x0a\x14\x1e\x28", "\x14\x0a\x28\x1e", "\x28\x1e\x14\x0a", "\x1e\x28\x0a\x14",
                              "\x0a\x1e\x14\x28", "\x1e\x0a\x28\x14", "\x28\x14\x1e\x0a", "\x14\x28\x0a\x1e"};
        for (int mark = 1; mark <= 8; ++mark) QTest::addRow("mark %d", mark) << mark << QByteArray(rows[mark - 1], 4);
    }
    void pngIsTurnedAsItsMarkSays()
    {
        QFETCH(const int, mark);
        QFETCH(const QByteArray, shown);
        QByteArray bytes = QByteArray::fromHex(
            "89504e470d0a1a0a0000000d494844520000000200000002080000000057dd52f80000001a655849664d4d002a00000008000101120003000000"
            "010006000000000000d6674b690000000e49444154789c63e0126190d3000000ec0065e0f85cd30000000049454e44ae426082");
        const qsizetype chunk = bytes.indexOf("eXIf");
        bytes[chunk + 4 + 19] = static_cast<char>(mark);
        bytes.replace(chunk + 4 + 26, 4, bigEndian(crcOf(bytes.mid(chunk, 4 + 26))));
        const fs::path file = pathOf(m_folder) / "turned.png";
        write(file, bytes.toStdString());
        const cv::Mat image = readPng(file);
        QCOMPARE(QByteArray(reinterpret_cast<const char*>(image.data), 4), shown);
    }

    void pngPalettesAndTransparencyAreUndone()
    {
        // One red pixel through a palette with a tRNS chunk; Python's struct and zlib packed the chunks.
        const QByteArray bytes = QByteArray::fromHex(
            "89504e470d0a1a0a0000000d494844520000000100000001080300000028cb34bb00000003504c5445ff000019e20937"
            "0000000174524e5380ad5e5b460000000a49444154789c636000000002000148afa4710000000049454e44ae426082");
        const fs::path file = pathOf(m_folder) / "palette.png";
        write(file, bytes.toStdString());
        const cv::Mat image = readPng(file);
        QCOMPARE(image.type(), int(CV_8UC3));
        QVERIFY(image.at<cv::Vec3b>(0, 0) == cv::Vec3b(255, 0, 0));
    }

    /// 40 texts of 8 MB in 0.3 MB; libpng unpacks and keeps up to 1000 of them.
    void pngTextsAndProfilesAreSkipped()
    {
        const QByteArray packed = deflated(QByteArray(7'900'000, 'a'));
        QByteArray chunks = chunkOf("iCCP", QByteArray("p\0\0", 3) + packed);
        for (int i = 0; i < 20; ++i)
            chunks += chunkOf("zTXt", QByteArray("k\0\0", 3) + packed) + chunkOf("iTXt", QByteArray("k\0\1\0\0\0", 6) + packed);
        QByteArray mark = QByteArray::fromHex("4d4d002a00000008000101120003000000010006000000000000");
        const fs::path file = pathOf(m_folder) / "texts.png";
        write(file, pngOf({2, 2}, 8, Grey, chunks + chunkOf("eXIf", mark), QByteArray("\0\x0a\x14\0\x1e\x28", 6)));
        const double before = mostMemoryMb();
        const cv::Mat image = readPng(file);
        QVERIFY2(mostMemoryMb() - before < 60, qPrintable(QString::number(mostMemoryMb() - before)));
        QCOMPARE(QByteArray(reinterpret_cast<const char*>(image.data), 4), QByteArray("\x1e\x0a\x28\x14"));  // turned as marked
    }

    /// Such files have fewer bytes than a bound on decoded samples allows.
    void pngOfOneColourIsRead()
    {
        const fs::path file = pathOf(m_folder) / "even.png";
        const QByteArray whiteRow = QByteArray(1, '\0') + QByteArray(500, '\xff');
        write(file, pngOf({4000, 4000}, 1, Grey, {}, whiteRow.repeated(4000)));
        const cv::Mat white = readPng(file);
        QCOMPARE(white.size(), cv::Size(4000, 4000));
        QCOMPARE(cv::countNonZero(white == 255), 16'000'000);
        write(file, pngOf({2000, 2000}, 8, Palette, chunkOf("PLTE", "\x0a\x14\x1e"), QByteArray(2001 * 2000, '\0')));
        const cv::Mat even = readPng(file);
        QVERIFY(even.size() == cv::Size(2000, 2000) && even.at<cv::Vec3b>(1999, 1999) == cv::Vec3b(10, 20, 30));
    }

    /// The file is long enough for its header, so that only the size in memory decides.
    void pngThatNeedsTooMuchMemoryIsRefused()
    {
        const fs::path file = pathOf(m_folder) / "deep.png";
        const QByteArray padding = chunkOf("tEXt", QByteArray("k\0", 2) + QByteArray(1'600'000, 'a'));
        write(file, pngOf({16384, 16384}, 16, Rgb, padding, QByteArray(1000, '\0')));
        const std::string deep = refusalOf([&] { readPng(file); });
        QVERIFY2(contains(deep, "16384 x 16384 pixels of 6 bytes") && contains(deep, "at most 268435456 pixels"), deep.c_str());
        QVERIFY(contains(deep, file.string()));
        write(file, pngOf({16384, 16384}, 8, Rgb, padding, QByteArray(1000, '\0')));
        const std::string usual = refusalOf([&] { readPng(file); });
        QVERIFY2(!usual.empty() && !contains(usual, "pixels"), usual.c_str());  // The size is allowed; its rows are missing.
    }

    void tiffComesBackBitForBitAndWritingLeavesTheImageAlone()
    {
        const cv::Mat height = wavyHeight(31, 45), before = height.clone();
        const fs::path file = pathOf(m_folder) / "height.tiff";
        writeTiff(file, height);
        QVERIFY(sameBits(height, before));
        QVERIFY(sameBits(readTiff(file), height));
    }

    /// The libraries in C call our functions, and no exception may pass through them.
    void memoryThatEndsWhileAnImageIsEncodedIsNamed()
    {
        cv::Mat noise(512, 512, CV_8UC3), height(512, 512, CV_32FC1);
        cv::randu(noise, 0, 256);
        cv::randu(height, 0, 1);
        for (const auto& [name, writeIt] : {std::pair<const char*, std::function<void(const fs::path&)>>{
                                                "noise.png", [&](const fs::path& file) { writePng(file, noise); }},
                                            {"noise.tiff", [&](const fs::path& file) { writeTiff(file, height); }}}) {
            const fs::path file = pathOf(m_folder) / name;
            const auto limited = [&] {
                largestAllocation = 1 << 16;
                writeIt(file);
            };
            const std::string fault = refusalOf(limited, protocols::ExitCode::Environment);
            largestAllocation = std::numeric_limits<std::size_t>::max();
            QVERIFY2(contains(fault, "the memory is used up") && contains(fault, name), fault.c_str());
            QVERIFY(!fs::exists(file));
            writeIt(file);
            QVERIFY(fs::exists(file));
        }
    }

    /// ZSTD states a repetition by its length: a blank scan of 16 MB has 620 bytes.
    void tiffOfOneColourIsRead()
    {
        constexpr quint32 side = 4000, strip = 122, shortest = 3, longest = 4, zstd = 50000;
        constexpr quint32 block = 131072, blocks = side * side / block;
        QByteArray frame("\x28\xb5\x2f\xfd\x00\x38", 6);  // no size, a window of 128 KiB
        for (quint32 b = 0; b <= blocks; ++b) {
            const quint32 header = (b < blocks ? block : side * side % block) << 3 | 1 << 1 | quint32(b == blocks);
            frame += QByteArray::fromRawData(reinterpret_cast<const char*>(&header), 3) + char(7);
        }
        const quint32 entries[][3] = {{256, longest, side},  {257, longest, side}, {258, shortest, 8},
                                      {259, shortest, zstd}, {262, shortest, 1},   {273, longest, strip},
                                      {277, shortest, 1},    {278, longest, side}, {279, longest, quint32(frame.size())}};
        QByteArray tiff("II*\0\x08\0\0\0\x09\0", 10);
        for (const auto& [tag, type, value] : entries) {
            const quint32 words[] = {tag | type << 16, 1, value};
            tiff += QByteArray(reinterpret_cast<const char*>(words), sizeof words);
        }
        const fs::path file = pathOf(m_folder) / "even.tiff";
        tiff += QByteArray(4, '\0') + frame;
        write(file, tiff.toStdString());
        const cv::Mat even = readTiff(file);
        QVERIFY(even.size() == cv::Size(side, side) && cv::countNonZero(even == 7) == side * side);
        write(file, tiff.replace(10 + 3 * 12 + 8, 2, "\x01\0", 2).toStdString());  // calls itself uncompressed
        QVERIFY(contains(refusalOf([&] { readTiff(file); }), "truncated"));
    }

    /// Read as they stand, negatives exchanged high and low friction, and pictures lay on their side.
    void tiffMarksThatChangeThePictureAreRefused_data()
    {
        QTest::addColumn<int>("kind");
        QTest::addColumn<int>("orientation");
        QTest::addColumn<QString>("words");
        QTest::newRow("0 is white") << 0 << 1 << "save it as BlackIsZero, or convert it to PNG";
        QTest::newRow("other colours") << 8 << 1 << "neither grey nor RGB";
        QTest::newRow("on its side") << 1 << 6 << "upright";
        QTest::newRow("mirrored") << 1 << 4 << "upright";
    }
    void tiffMarksThatChangeThePictureAreRefused()
    {
        QFETCH(const int, kind);
        QFETCH(const int, orientation);
        QFETCH(const QString, words);
        const fs::path file = pathOf(m_folder) / "marked.tif";
        using Reader = cv::Mat (*)(const fs::path&);
        for (const Reader reader : {Reader(readImage), Reader(readColourTiff)}) {
            write(file, greyTiff(1, 1));
            QCOMPARE(int(reader(file).at<uchar>(0, 1)), 200);
            write(file, greyTiff(quint32(kind), quint32(orientation)));
            const std::string refusal = refusalOf([&] { reader(file); });
            QVERIFY2(contains(refusal, words.toStdString()) && contains(refusal, file.string()), refusal.c_str());
        }
    }

    void npyComesBackBitForBit_data()
    {
        QTest::addColumn<int>("type");
        for (const int type : {CV_32FC1, CV_64FC1, CV_8UC1, CV_16UC1, CV_8UC3}) QTest::addRow("type %d", type) << type;
    }

    void npyComesBackBitForBit()
    {
        QFETCH(int, type);
        cv::Mat array;
        speckled(7, 5, CV_8UC(CV_MAT_CN(type))).convertTo(array, CV_MAT_DEPTH(type), 1.25);
        const fs::path file = pathOf(m_folder) / "array.npy";
        writeNpy(file, array);
        QVERIFY(sameBits(readNpy(file), array));
        QCOMPARE(read(file).size() % 64, std::size_t(array.total() * array.elemSize()) % 64);
    }

    void npyIntegersBecomeDouble()
    {
        std::string header = "{'descr': '<i4', 'fortran_order': False, 'shape': (3,), }";
        header.append(117 - header.size(), ' ');
        header += '\n';
        std::string bytes("\x93NUMPY\x01\x00", 8);
        bytes += char(header.size());
        bytes += '\0';
        bytes += header;
        for (const std::int32_t value : {-5, 0, 70000}) bytes.append(reinterpret_cast<const char*>(&value), 4);
        const fs::path file = pathOf(m_folder) / "integers.npy";
        write(file, bytes);
        const cv::Mat array = readNpy(file);
        QCOMPARE(array.type(), int(CV_64FC1));
        QCOMPARE(array.rows, 1);
        QCOMPARE(array.at<double>(0, 0), -5.0);
        QCOMPARE(array.at<double>(0, 2), 70000.0);
    }

    void pgmFilesOfOneSizeHaveOneLength()
    {
        const fs::path flat = pathOf(m_folder) / "flat.pgm", busy = pathOf(m_folder) / "busy.pgm";
        writePgm(flat, cv::Mat(20, 30, CV_8UC1, cv::Scalar(7)));
        writePgm(busy, speckled(20, 30, CV_8UC1));
        QCOMPARE(fs::file_size(flat), fs::file_size(busy));
        QVERIFY(sameBits(readPgm(busy), speckled(20, 30, CV_8UC1)));
        QVERIFY(read(flat).starts_with("P5\n30 20\n255\n"));
    }

    void damagedFilesAreRefusedByName_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QByteArray>("bytes");
        const fs::path folder = pathOf(m_folder);
        writePng(folder / "whole.png", speckled(40, 40, CV_8UC3));
        writeTiff(folder / "whole.tiff", wavyHeight(40, 40));
        writeNpy(folder / "whole.npy", wavyHeight(8, 8));
        writePgm(folder / "whole.pgm", speckled(8, 8, CV_8UC1));
        for (const char* ending : {"png", "tiff", "npy", "pgm"}) {
            const QByteArray whole = QByteArray::fromStdString(read(folder / (std::string("whole.") + ending)));
            const QString name = QString("damaged.") + ending;
            QTest::addRow("empty %s", ending) << name << QByteArray();
            QTest::addRow("%s cut in its header", ending) << name << whole.left(9);
            QTest::addRow("%s cut in the middle", ending) << name << whole.left(whole.size() / 2);
            QTest::addRow("%s cut near its end", ending) << name << whole.left(whole.size() - 20);
            QTest::addRow("%s of other bytes", ending) << name << QByteArray(500, 'x');
        }
        QByteArray huge = QByteArray::fromStdString(read(folder / "whole.png"));
        huge.replace(16, 4, QByteArray("\x00\x10\x00\x00", 4));
        QTest::newRow("png with a false width") << QString("damaged.png") << huge;
        QByteArray promised = QByteArray::fromStdString(read(folder / "whole.npy"));
        promised.replace("(8, 8)", "(9, 9)");
        QTest::newRow("npy with a false shape") << QString("damaged.npy") << promised;
        QByteArray turned = QByteArray::fromStdString(read(folder / "whole.npy"));
        turned.replace("False", "True ");
        QTest::newRow("npy in Fortran order") << QString("damaged.npy") << turned;
        QByteArray swapped = QByteArray::fromStdString(read(folder / "whole.npy"));
        swapped.replace("<f4", ">f4");
        QTest::newRow("big-endian npy") << QString("damaged.npy") << swapped;
    }

    void damagedFilesAreRefusedByName()
    {
        QFETCH(QString, name);
        QFETCH(QByteArray, bytes);
        const fs::path file = pathOf(m_folder) / name.toStdString();
        write(file, bytes.toStdString());
        const std::string refusal = refusalOf([&] { readImage(file); });
        QVERIFY2(contains(refusal, file.string()), refusal.c_str());
    }

    void missingFilesFoldersAndOtherEndingsAreRefused()
    {
        const fs::path folder = pathOf(m_folder);
        QVERIFY(contains(refusalOf([&] { readImage(folder / "no.png"); }), "no.png"));
        fs::create_directories(folder / "folder.png");
        QVERIFY(contains(refusalOf([&] { readImage(folder / "folder.png"); }), "folder"));
        QVERIFY(contains(refusalOf([&] { readImage(folder / "photo.xyz"); }), ".png"));
    }

    void writingWhereNothingCanBeWrittenIsAFaultOfTheEnvironment()
    {
        const fs::path file = pathOf(m_folder) / "no such folder" / "picture.png";
        const auto refusal = refusalOf([&] { writePng(file, speckled(4, 4, CV_8UC1)); }, protocols::ExitCode::Environment);
        QVERIFY2(contains(refusal, "picture.png") && !contains(refusal, "wrong exit code"), refusal.c_str());
        const auto full =
            refusalOf([] { protocols::writeWholeFile("/dev/full/picture", "x"); }, protocols::ExitCode::Environment);
        QVERIFY(!contains(full, "wrong exit code") && !full.empty());
    }

private:
    QTemporaryDir m_folder;
};

QTEST_GUILESS_MAIN(ImageIoTest)
#include "image_io_test.moc"
