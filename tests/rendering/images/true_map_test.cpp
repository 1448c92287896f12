// Height maps of profilometers are read whole. Truncated and foreign files are refused by name.
#include "rendering/images/true_map.h"

#include <QTest>
#include <cmath>
#include <cstring>

#include "tests/rendering/refusal.h"

using rendering::trueMapFrom;

namespace {

template <class T>
std::string bytesOf(T value)
{
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
}

std::string mapBytes(std::uint32_t columns, std::uint32_t rows, float width, float height, const std::vector<float>& heights)
{
    std::string bytes("Binary TrueMap Data File v2.0\r\n", 31);
    bytes += '\0';
    bytes += "a comment";
    bytes += '\0';
    bytes += bytesOf(columns) + bytesOf(rows) + bytesOf(width) + bytesOf(height) + bytesOf(0.F) + bytesOf(0.F);
    for (const float value : heights) bytes += bytesOf(value);
    return bytes;
}

}  // namespace

class TrueMapTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void heightsAndPitchAreRead()
    {
        const auto map = trueMapFrom(mapBytes(3, 2, 1.5F, 0.5F, {1, 2, 3, 4, 5, 6}), "m.tmd");
        QCOMPARE(map.heightMm.size(), cv::Size(3, 2));
        QCOMPARE(map.heightMm.at<float>(1, 0), 4.F);
        QCOMPARE(map.xPitchMm, 0.5);
        QCOMPARE(map.yPitchMm, 0.25);
        QCOMPARE(map.comment, std::string("a comment"));
    }

    void missingPointsAreNaN()
    {
        const auto map = trueMapFrom(mapBytes(2, 2, 1, 1, {1, -1e10F, std::nanf(""), -0.5F}), "m.tmd");
        QVERIFY(std::isnan(map.heightMm.at<float>(0, 1)) && std::isnan(map.heightMm.at<float>(1, 0)));
        QCOMPARE(map.heightMm.at<float>(1, 1), -0.5F);
    }

    void otherSpellingsOfTheHeaderAreRead()
    {
        auto bytes = mapBytes(1, 1, 1, 1, {7});
        bytes.replace(7, 7, "TRUEMAP");
        QCOMPARE(trueMapFrom(bytes, "m.tmd").heightMm.at<float>(0, 0), 7.F);
    }

    void brokenFilesAreRefusedByName_data()
    {
        QTest::addColumn<QByteArray>("bytes");
        QTest::addColumn<QString>("named");
        const auto row = [](const char* name, const std::string& bytes, const char* named) {
            QTest::newRow(name) << QByteArray::fromStdString(bytes) << QString(named);
        };
        const auto sound = mapBytes(3, 2, 1, 1, {1, 2, 3, 4, 5, 6});
        row("empty", "", "unknown header");
        row("text", "a,b,c\n1,2,3\n", "unknown header");
        row("header alone", sound.substr(0, 32), "truncated in its header");
        row("comment without end", sound.substr(0, 36), "truncated in its header");
        row("sizes cut", sound.substr(0, 50), "truncated in its header");
        row("heights cut", sound.substr(0, sound.size() - 5), "truncated after 4 of 6");
        row("no points", mapBytes(0, 2, 1, 1, {}), "no points");
        row("too many points", mapBytes(0xffffffffU, 0xffffffffU, 1, 1, {}), "2^28");
        row("no width", mapBytes(1, 1, 0, 1, {1}), "not positive");
        row("width not a number", mapBytes(1, 1, std::nanf(""), 1, {1}), "not positive");
    }
    void brokenFilesAreRefusedByName()
    {
        QFETCH(QByteArray, bytes);
        QFETCH(QString, named);
        const auto refusal = refusalOf([&] { trueMapFrom(bytes.toStdString(), "broken.tmd"); });
        QVERIFY2(refusal.contains(named) && refusal.contains("broken.tmd"), qPrintable(refusal));
    }
};

QTEST_GUILESS_MAIN(TrueMapTest)
#include "true_map_test.moc"
