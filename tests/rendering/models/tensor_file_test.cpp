// Files of plain tensors: written and read back, read by numpy, and refused where any number of the header is wrong.
#include "rendering/models/tensors/tensor_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <QElapsedTimer>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "protocols/random.h"
#include "rendering/models/model_card_fields.h"
#include "tests/support/error_text.h"
#include "tests/support/mutated_files.h"

using namespace rendering::models;
using tests::support::errorOf;
namespace fs = std::filesystem;

namespace {

const TensorSource source{"weights.safetensors", "a weights file", "use another"};

std::string bytesOfFloats(const std::vector<float>& values)
{
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

std::string withHeader(const std::string& header, const std::string& data)
{
    const std::uint64_t length = header.size();
    std::string bytes(8, '\0');
    std::memcpy(bytes.data(), &length, 8);
    return bytes + header + data;
}

TensorFile smallFile()
{
    return {{{"format", "vis2hap.weights/1"}},
            {{{"steps", Element::I64, {}}, std::string("\x07\0\0\0\0\0\0\0", 8)},
             {{"bias", Element::F32, {2}}, bytesOfFloats({0.5F, -3})},
             {{"weight", Element::F16, {2, 3}}, std::string("\x00\x3C\x00\xC0\x00\x00\x01\x00\xFF\x7B\x55\x35", 12)}}};
}

std::vector<TensorKind> kindsIn(const TensorFile& file)
{
    std::vector<TensorKind> kinds;
    for (const StoredTensor& tensor : file.tensors) kinds.push_back(tensor.kind);
    return kinds;
}

/// A sound file, of which the first `changeable` bytes are mutated, and its tensors.
struct Seed {
    std::string bytes;
    std::size_t changeable = 0;
    std::vector<TensorKind> wanted;
};

Seed seedOf(const TensorFile& file) { return {tensorFileBytes(file), tensorFileBytes(file).size(), kindsIn(file)}; }

/// The shipped weights, with a header of their own; their numbers stay, so that the header is what changes.
Seed shippedSeed()
{
    Seed seed{protocols::readWholeFile(shippedModel()), 0, {}};
    std::uint64_t length = 0;
    std::memcpy(&length, seed.bytes.data(), 8);
    seed.changeable = 8 + length;
    const auto header = nlohmann::json::parse(seed.bytes.substr(8, length));
    for (const auto& [name, entry] : header.items()) {
        if (name == "__metadata__") continue;
        const std::string kind = entry["dtype"];
        seed.wanted.push_back({name, kind == "F16" ? Element::F16 : kind == "F32" ? Element::F32 : Element::I64, entry["shape"]});
    }
    return seed;
}

}  // namespace

class TensorFileTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;
    fs::path at(const char* name) const { return fs::path(m_folder.path().toStdString()) / name; }

private Q_SLOTS:
    void fileIsReadBackAsWritten()
    {
        const TensorFile file = smallFile();
        const std::string bytes = tensorFileBytes(file);
        QVERIFY(parseTensorFile(bytes, kindsIn(file), source) == file);
        QVERIFY(tensorMetadata(bytes, source) == file.metadata);
        std::uint64_t length = 0;
        std::memcpy(&length, bytes.data(), 8);
        QCOMPARE(length % 8, std::uint64_t{0});  // The numbers are aligned.
        QCOMPARE(bytes.size(), 8 + length + 8 + 8 + 12);
    }

    void tensorsComeInTheWantedOrder()
    {
        const TensorFile file = smallFile();
        const std::vector<TensorKind> wanted{file.tensors[2].kind, file.tensors[0].kind, file.tensors[1].kind};
        const TensorFile read = parseTensorFile(tensorFileBytes(file), wanted, source);
        QVERIFY(read.tensors[0] == file.tensors[2] && read.tensors[1] == file.tensors[0] && read.tensors[2] == file.tensors[1]);
    }

    /// How anybody reads a weights file, without this program and without torch.
    void numpyReadsTheShippedWeights()
    {
        const char* program = R"(import json, sys, numpy
with open(sys.argv[1], 'rb') as file:
    header = json.loads(file.read(int.from_bytes(file.read(8), 'little')))
    data = file.read()
kinds = {'F16': '<f2', 'F32': '<f4', 'I64': '<i8'}
tensors = {name: numpy.frombuffer(data[slice(*t['data_offsets'])], kinds[t['dtype']]).reshape(t['shape']) for name, t in header.items() if name != '__metadata__'}
print(len(tensors), sum(t.size for t in tensors.values()), all(numpy.isfinite(t).all() for t in tensors.values()), tensors['relief.out.weight'].shape)
)";
        if (QProcess::execute("/usr/bin/python3", {"-c", "import numpy"}) != 0) QSKIP("numpy is not installed");
        QProcess python;
        python.start("/usr/bin/python3", {"-c", program, QString::fromStdString(shippedModel().string())});
        QVERIFY(python.waitForFinished(60000));
        QVERIFY2(python.exitCode() == 0, python.readAllStandardError().constData());
        const QString printed = python.readAllStandardOutput().trimmed();
        QVERIFY2(printed.startsWith("122 ") && printed.contains(" True (4, 24, 3, 3)"), qPrintable(printed));
    }

    void wrongHeadersAreRefused_data()
    {
        QTest::addColumn<QByteArray>("bytes");
        QTest::addColumn<QString>("named");
        // The one wanted tensor is "a", F32 [2].
        const std::string eight(8, '\0');
        const auto entry = [](const std::string& name, const std::string& rest) { return "\"" + name + "\":{" + rest + "}"; };
        const auto row = [&](const char* label, const std::string& header, const std::string& data, const char* named) {
            const std::string bytes = withHeader(header, data);
            QTest::newRow(label) << QByteArray(bytes.data(), static_cast<qsizetype>(bytes.size())) << named;
        };
        const std::string good = R"("dtype":"F32","shape":[2],"data_offsets":[0,8])";
        row("right", "{" + entry("a", good) + "}", eight, "");
        row("right, with spaces", "{" + entry("a", good) + "}   ", eight, "");
        row("no JSON", "{" + entry("a", good), eight, "JSON");
        row("a list", "[1]", eight, "does not begin with {");
        row("a doubled name", "{" + entry("a", good) + "," + entry("a", good) + "}", eight, "JSON");
        row("another kind", "{" + entry("a", R"("dtype":"F16","shape":[4],"data_offsets":[0,8])") + "}", eight,
            "expected F32 [2]");
        row("an unknown kind", "{" + entry("a", R"("dtype":"F64","shape":[1],"data_offsets":[0,8])") + "}", eight,
            "unknown kind");
        row("a kind that is no text", "{" + entry("a", R"("dtype":4,"shape":[1],"data_offsets":[0,8])") + "}", eight,
            "unknown kind");
        row("another shape", "{" + entry("a", R"("dtype":"F32","shape":[1,2],"data_offsets":[0,8])") + "}", eight, "[1, 2]");
        row("a field more", "{" + entry("a", good + R"(,"code":"x")") + "}", eight, "dtype, shape and data_offsets");
        row("a field less", "{" + entry("a", R"("dtype":"F32","shape":[2])") + "}", eight, "dtype, shape and data_offsets");
        row("a negative length", "{" + entry("a", R"("dtype":"F32","shape":[-2],"data_offsets":[0,8])") + "}", eight,
            "whole number");
        row("half a length", "{" + entry("a", R"("dtype":"F32","shape":[2.5],"data_offsets":[0,8])") + "}", eight,
            "whole number");
        row("a length beyond 64 bits",
            "{" + entry("a", R"("dtype":"F32","shape":[99999999999999999999],"data_offsets":[0,8])") + "}", eight,
            "whole number");
        row("a product beyond 64 bits",
            "{" + entry("a", R"("dtype":"F32","shape":[4294967296,4294967296,2],"data_offsets":[0,8])") + "}", eight, "offsets");
        row("a product that wraps to the right size",
            "{" + entry("a", R"("dtype":"F32","shape":[4611686018427387904,2],"data_offsets":[0,0])") + "}", "", "offsets");
        row("many dimensions", "{" + entry("a", R"("dtype":"F32","shape":[1,1,1,1,1,1,1,1,2],"data_offsets":[0,8])") + "}", eight,
            "right length");
        row("one offset", "{" + entry("a", R"("dtype":"F32","shape":[2],"data_offsets":[8])") + "}", eight, "right length");
        row("offsets the wrong way", "{" + entry("a", R"("dtype":"F32","shape":[2],"data_offsets":[8,0])") + "}", eight,
            "offsets");
        row("offsets beyond the file", "{" + entry("a", R"("dtype":"F32","shape":[2],"data_offsets":[0,8])") + "}", "abcd", "4");
        row("offsets far beyond",
            "{" + entry("a", R"("dtype":"F32","shape":[2],"data_offsets":[9223372036854775799,9223372036854775807])") + "}",
            eight, "begins at byte");
        row("a gap before", "{" + entry("a", R"("dtype":"F32","shape":[2],"data_offsets":[4,12])") + "}", eight + "abcd",
            "begins at byte 4");
        row("bytes behind", "{" + entry("a", good) + "}", eight + "PK", "describes 8 bytes");
        row("shared bytes", "{" + entry("a", good) + "," + entry("b", R"("dtype":"F32","shape":[1],"data_offsets":[4,8])") + "}",
            eight, "begins at byte 4");
        row("a tensor more",
            "{" + entry("a", good) + "," + entry("b", R"("dtype":"F32","shape":[1],"data_offsets":[8,12])") + "}", eight + "abcd",
            "'b' does not belong");
        row("a tensor without numbers more",
            "{" + entry("a", good) + "," + entry("b", R"("dtype":"F32","shape":[0],"data_offsets":[8,8])") + "}", eight,
            "'b' does not belong");
        row("another name", "{" + entry("b", good) + "}", eight, "'a' is missing");
        row("no tensor", "{}", "", "'a' is missing");
        row("metadata that are no texts", R"({"__metadata__":{"x":1},)" + entry("a", good) + "}", eight, "not a text");
        row("metadata that are a list", R"({"__metadata__":["x"],)" + entry("a", good) + "}", eight, "not an object");
        row("not a number", "{" + entry("a", good) + "}", bytesOfFloats({0, std::numeric_limits<float>::quiet_NaN()}),
            "not finite");
        row("infinite", "{" + entry("a", good) + "}", bytesOfFloats({-std::numeric_limits<float>::infinity(), 0}), "not finite");
        row("deep", "{" + entry("a", R"("dtype":"F32","shape":)" + std::string(100000, '[')) + "}", eight, "JSON");
        const auto raw = [](const char* label, std::string bytes, const char* named) {
            QTest::newRow(label) << QByteArray(bytes.data(), static_cast<qsizetype>(bytes.size())) << named;
        };
        raw("empty", "", "too short");
        raw("seven bytes", "1234567", "too short");
        raw("a header beyond the file", std::string("\x40\0\0\0\0\0\0\0{}", 10), "header of 64 bytes");
        raw("a header of 2^64 - 1 bytes", std::string(8, '\xFF') + "{}", "18446744073709551615");
        raw("a header of 2 MB", withHeader("{" + entry("a", good) + "}" + std::string(2000000, ' '), eight),
            "header of 2000054 bytes");
    }

    void wrongHeadersAreRefused()
    {
        QFETCH(QByteArray, bytes);
        QFETCH(QString, named);
        const std::vector<TensorKind> wanted{{"a", Element::F32, {2}}};
        const QString fault = errorOf([&] {
            (void)parseTensorFile({bytes.data(), static_cast<std::size_t>(bytes.size())}, wanted, source);
        });
        if (named.isEmpty()) {
            QCOMPARE(fault, "");
            return;
        }
        QVERIFY2(fault.startsWith("2: ") && fault.contains("weights.safetensors") && fault.contains(named), qPrintable(fault));
        QVERIFY2(!fault.contains('\n') && fault.size() < 600, qPrintable(fault));
    }

    void halfNumbersThatAreNotFiniteAreRefused()
    {
        for (const char* number : {"\x00\x7C", "\x00\xFC", "\x01\x7E"}) {
            TensorFile file = smallFile();
            file.tensors[2].bytes.replace(4, 2, std::string(number, 2));
            const QString fault = errorOf([&] { (void)parseTensorFile(tensorFileBytes(file), kindsIn(file), source); });
            QVERIFY2(fault.contains("'weight' holds numbers that are not finite"), qPrintable(fault));
        }
    }

    void namesAreShownWithoutControlCharacters()
    {
        const std::string entry = R"({"dtype":"F32","shape":[0],"data_offsets":[0,0]})";
        const QString fault =
            errorOf([&] { (void)parseTensorFile(withHeader("{\"\\u001b[2J\\n\":" + entry + "}", ""), {}, source); });
        QVERIFY2(fault.contains("'?[2J?' does not belong"), qPrintable(fault));
    }

    void whatIsNoRegularFileIsRefusedAtOnce()
    {
        QVERIFY(::mkfifo(at("pipe").c_str(), 0600) == 0);
        protocols::writeWholeFile(at("sparse"), "{}");
        QVERIFY(::truncate(at("sparse").c_str(), off_t{1} << 42) == 0);
        protocols::writeWholeFile(at("archive"), std::string("PK\x03\x04 and objects", 16));
        const std::vector<TensorKind> wanted{{"a", Element::F32, {2}}};
        QElapsedTimer time;
        time.start();
        for (const auto& [file, named] :
             std::vector<std::pair<fs::path, const char*>>{{at("pipe"), "is a pipe"},
                                                           {at("sparse"), "has 4398046511104 bytes"},
                                                           {at("archive"), "is an archive of objects, which can hold code"},
                                                           {at(""), "is a folder"},
                                                           {at("absent"), "cannot be read"},
                                                           {"/dev/zero", "is a device"}}) {
            const QString fault = errorOf([&, path = file] {
                (void)readTensorBytes(wanted, {path, "a weights file", "use another"});
            });
            QVERIFY2(fault.startsWith("2: ") && fault.contains(named) && !fault.contains('\n'), qPrintable(fault));
        }
        QVERIFY(time.elapsed() < 1000);
    }

    /// A mutated file is refused by name, or it is still right; nothing else happens. VIS2HAP_FUZZ_SECONDS makes it longer.
    void mutatedFilesAreReadOrRefused()
    {
        TensorFile checkpoint = smallFile();
        checkpoint.metadata["state"] = R"({"step":7,"best_distance":1e+300})";
        const Seed seeds[] = {seedOf(smallFile()), seedOf(checkpoint), seedOf({}), shippedSeed()};
        protocols::Random random(15);
        QElapsedTimer time;
        time.start();
        int read = 0, refused = 0;
        while (static_cast<double>(time.elapsed()) < 1000 * mutated_files::fuzzSeconds(5)) {
            const Seed& seed = seeds[static_cast<std::size_t>(read + refused) % std::size(seeds)];
            const std::string bytes =
                mutated_files::mutated(seed.bytes.substr(0, seed.changeable), random) + seed.bytes.substr(seed.changeable);
            const QString fault = errorOf([&] {
                (void)tensorMetadata(bytes, source);
                const TensorFile file = parseTensorFile(bytes, seed.wanted, source);
                if (!(kindsIn(file) == seed.wanted)) throw std::logic_error("other tensors than the wanted ones");
                for (const StoredTensor& tensor : file.tensors)
                    if (tensor.bytes.size() != byteCount(tensor.kind)) throw std::logic_error("a tensor of another size");
            });
            QVERIFY2(fault.isEmpty() || (fault.startsWith("2: ") && !fault.contains('\n')), qPrintable(fault));
            ++(fault.isEmpty() ? read : refused);
        }
        QVERIFY2(read > 20 && refused > 1000, qPrintable(QString("%1 read, %2 refused").arg(read).arg(refused)));
        qInfo("%d files read, %d refused", read, refused);
    }
};

QTEST_GUILESS_MAIN(TensorFileTest)
#include "tensor_file_test.moc"
