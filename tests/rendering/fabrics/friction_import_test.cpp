// Import of friction records: zero, axes, units, the steady slide and even steps. Everything that the import did is
// reported and saved.
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "rendering/fabrics/dataset_check.h"
#include "rendering/fabrics/recordings/friction_plot.h"
#include "rendering/fabrics/recordings/import.h"
#include "tests/rendering/fabric_files.h"
#include "tests/rendering/stroke_text.h"

using namespace fabric_files;
using namespace rendering;
using namespace rendering::fabrics;
using stroke_text::number;
using stroke_text::Stroke;
using stroke_text::WrittenSample;

namespace {

/// Forces in N at 500 Hz from 0 to `seconds`; `normal` and `tangential` take the time in s.
std::string forcesOver(double seconds, const std::function<double(double)>& normal,
                       const std::function<double(double)>& tangential)
{
    protocols::Random random(4);
    std::string text = "time_s,Fx_N,Fz_N\n";
    for (int i = 0; i < int(500 * seconds); ++i) {
        const double t = i / 500.0;
        text += number(t) + "," + number(tangential(t) + 0.004 * random.normal()) + "," +
                number(normal(t) + 0.004 * random.normal()) + "\n";
    }
    return text;
}

double meanOf(const std::vector<double>& values)
{
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / double(values.size());
}

}  // namespace

class FrictionImportTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init()
    {
        m_folder = std::make_unique<QTemporaryDir>();
        m_in = pathOf(*m_folder) / "in";
        m_out = pathOf(*m_folder) / "set";
        m_options = {};
        m_plots.clear();
    }

    void onlyTheSteadySlideIsKept()
    {
        const auto line = imported(stroke_text::twoForces());
        const auto report = saved();
        QVERIFY2(contains(line, "approach") && contains(line, "breakaway") && contains(line, "stop") && contains(line, "cut"),
                 line.c_str());
        const double from = report["slide"]["from_s"], to = report["slide"]["to_s"];
        QVERIFY2(from > 1.2 && from < 1.4 && to > 7.4 && to < 7.6, line.c_str());
        QVERIFY(report["cut"]["approach"]["samples"].get<int>() > 200);
        const auto record = readFriction(readDataset(m_out), FabricId("F01"), 0);
        QCOMPARE(record.timeS.front(), 0.0);
        for (const double mu : record.values) QVERIFY(mu > 0.42 && mu < 0.58);
        QVERIFY(std::abs(meanOf(record.values) - 0.5) < 0.002);
        QVERIFY(faultsOfDataset(m_out).empty());
    }

    void unloadedSamplesAreTheZeroOfTheSensor()
    {
        imported(stroke_text::twoForces());
        const auto zero = saved()["zero"];
        QVERIFY(std::abs(zero["normal_n"].get<double>() - 0.12) < 0.002);
        QVERIFY(std::abs(zero["tangential_n"][0].get<double>() + 0.08) < 0.002);
        // Without the subtraction the offsets of 0.12 and -0.08 N remain: (1 - 0.08) / 2.12.
        m_options.zero = Selection::None;
        imported(stroke_text::twoForces());
        QVERIFY(std::abs(meanOf(readFriction(readDataset(m_out), FabricId("F01"), 1).values) - 0.92 / 2.12) < 0.002);
    }

    void aStatedIntervalIsTheZero()
    {
        m_options.zero = Selection::Stated;
        m_options.zeroInterval = {8.4, 8.9};
        imported(stroke_text::twoForces());
        QVERIFY(std::abs(saved()["zero"]["from_s"].get<double>() - 8.4) < 0.01);
        QVERIFY(std::abs(saved()["zero"]["normal_n"].get<double>() - 0.12) < 0.002);
        m_options.zeroInterval = {20, 30};
        QVERIFY(contains(refusalOf([&] { imported(stroke_text::twoForces()); }), "--zero"));
    }

    void aRecordThatBeginsLoadedHasNoZero()
    {
        std::string text = "t_s,fn,ft\n";
        for (int i = 0; i < 400; ++i) text += number(i * 0.01) + "," + number(3 + 0.2 * std::sin(i)) + ",1.2\n";
        const auto line = imported(text);
        QVERIFY(saved()["zero"].is_null());
        QCOMPARE(saved()["why"]["zero"].get<std::string>(), std::string("no unloaded samples"));
        QVERIFY2(contains(line, "no zero taken (no unloaded samples found)"), line.c_str());
        QVERIFY2(contains(line, "the whole record is the slide"), line.c_str());
        QCOMPARE(readFriction(readDataset(m_out), FabricId("F01"), 0).values.size(), std::size_t(400));
    }

    /// Below 2 % of the record, the offset once stayed in both forces without a word, and this record gave 0.46.
    void aShortRestBeforeALongSlideIsTheZero()
    {
        const auto rest = [](double t) { return t < 1.5 ? 0.0 : 1.0; };
        const auto line = imported(forcesOver(
            121.5, [&](double t) { return 0.3 + rest(t); }, [&](double t) { return 0.2 + 0.4 * rest(t); }));
        QVERIFY2(contains(line, "zero from 675 unloaded samples"), line.c_str());
        QVERIFY(std::abs(saved()["mean"].get<double>() - 0.4) < 0.001);
    }

    void aShortRestAfterALongSlideIsTheZero()
    {
        const auto load = [](double t) { return t > 60 ? 0.0 : 1.0; };
        imported(forcesOver(
            60.5, [&](double t) { return 0.3 + load(t); }, [&](double t) { return 0.2 + 0.4 * load(t); }));
        QVERIFY(std::abs(saved()["zero"]["normal_n"].get<double>() - 0.3) < 0.001);
        QVERIFY(std::abs(saved()["mean"].get<double>() - 0.4) < 0.001);
    }

    /// The mean force of the first tenth of an approach is no zero.
    void aRecordThatBeginsWithItsApproachHasNoZero()
    {
        for (const double seconds : {0.1, 0.3, 1.0}) {
            const auto load = [&](double t) { return std::min(t / seconds, 1.0); };
            const auto line = imported(forcesOver(60, load, [&](double t) { return 0.4 * load(t); }));
            QVERIFY2(contains(line, "no zero taken (no unloaded samples found), so any offset of the sensor remains"),
                     line.c_str());
            QVERIFY2(contains(line, "mean 0.4"), line.c_str());
        }
        m_options.zero = Selection::None;
        QVERIFY(!contains(imported(forcesOver(
                              10, [](double) { return 1.0; }, [](double) { return 0.4; })),
                          "no zero taken"));
    }

    /// As a reciprocating tribometer writes them; their mean once became the friction.
    void strokesBackAndForthAreRefused_data()
    {
        QTest::addColumn<int>("strokes");
        QTest::addColumn<double>("strokeS");
        QTest::addColumn<double>("pauseS");
        QTest::addColumn<double>("turnDeg");
        QTest::newRow("there and back") << 2 << 4.0 << 0.0 << 0.0;
        QTest::newRow("three strokes") << 3 << 4.0 << 0.0 << 0.0;
        QTest::newRow("ten strokes") << 10 << 4.0 << 0.0 << 0.0;
        QTest::newRow("a hundred strokes") << 100 << 0.5 << 0.0 << 0.0;
        QTest::newRow("pauses at the ends") << 6 << 4.0 << 0.4 << 0.0;
        QTest::newRow("two axes") << 4 << 4.0 << 0.0 << 35.0;
        QTest::newRow("two axes, across the first") << 4 << 4.0 << 0.0 << 90.0;
    }
    void strokesBackAndForthAreRefused()
    {
        QFETCH(const int, strokes);
        QFETCH(const double, strokeS);
        QFETCH(const double, pauseS);
        QFETCH(const double, turnDeg);
        const double angle = turnDeg * std::numbers::pi / 180, endS = 1 + strokes * (strokeS + pauseS);
        protocols::Random random(3);
        std::string text = turnDeg == 0 ? "t_s,fx,fz\n" : "t_s,fx,fy,fz\n";
        for (double t = 0; t < endS; t += 0.002) {
            const int stroke = t < 1 ? -1 : int((t - 1) / (strokeS + pauseS));
            const bool pauses = t < 1 || t - 1 - stroke * (strokeS + pauseS) > strokeS;
            const double mu = pauses ? 0 : stroke % 2 == 0 ? 0.4 : -0.36;
            const double texture = pauses ? 0 : 0.03 * std::sin(2 * std::numbers::pi * 12 * t);
            const double force = mu + texture + 0.005 * random.normal();
            text += number(t) + "," + number(std::cos(angle) * force + 0.1) + ",";
            if (turnDeg != 0) text += number(std::sin(angle) * force - 0.1) + ",";
            text += number((t < 1 ? 0 : 1) + 0.05 + 0.005 * random.normal()) + "\n";
        }
        const std::string refusal = refusalOf([&] { imported(text); });
        QVERIFY2(contains(refusal, "the stroke runs in both directions: the tangential force points one way in") &&
                     contains(refusal, "Felt_1.csv, row ") && contains(refusal, "expected one stroke in one direction"),
                 refusal.c_str());
        QVERIFY(!fs::exists(m_out));
        // The message names one of the strokes.
        const std::string option = "such as --trim ";
        m_options.trim = selectionFrom(refusal.substr(refusal.find(option) + option.size()), "--trim", m_options.trimInterval);
        imported(text);
        const double mean = std::abs(saved()["mean"].get<double>());
        QVERIFY2(std::abs(mean - 0.4) < 0.02 || std::abs(mean - 0.36) < 0.02, refusal.c_str());
        QVERIFY(std::abs(m_options.trimInterval.toS - m_options.trimInterval.fromS - strokeS) < 0.1 * strokeS + 0.05);
    }

    /// What swings about a small friction is no stroke back.
    void forcesThatSwingAreTaken_data()
    {
        QTest::addColumn<QString>("kind");
        for (const char* kind : {"noise", "coarse sensor", "slow noise", "vibration", "slow vibration", "drift", "stick-slip",
                                 "ridges", "circle", "drift of no friction"})
            QTest::newRow(kind) << kind;
    }
    void forcesThatSwingAreTaken()
    {
        QFETCH(const QString, kind);
        protocols::Random random(5);
        double slow = 0;
        const auto wave = [](double hertz, double t) { return std::sin(2 * std::numbers::pi * hertz * t); };
        const std::map<QString, std::function<double(double)>> forces{
            {"noise", [&](double) { return 0.01 + 0.2 * random.normal(); }},
            {"coarse sensor", [&](double) { return 0.05 * std::round(0.2 + 1.2 * random.normal()); }},
            {"slow noise",
             [&](double) {
                 slow = 0.98 * slow + 0.02 * random.normal();
                 return 0.01 + slow;
             }},
            {"vibration", [&](double t) { return 0.02 + 0.2 * wave(40, t) + 0.01 * random.normal(); }},
            {"slow vibration", [&](double t) { return 0.02 + 0.2 * wave(2, t) + 0.01 * random.normal(); }},
            {"drift", [&](double t) { return 0.1 - 0.02 * t + 0.002 * random.normal(); }},
            {"stick-slip", [&](double t) { return -0.05 + 0.4 * (5 * t - std::floor(5 * t)) + 0.005 * random.normal(); }},
            {"ridges", [&](double t) { return 0.05 + 0.15 * wave(2, t) + 0.005 * random.normal(); }},
            {"circle", [&](double t) { return 0.4 * wave(0.5, t); }},
            {"drift of no friction", [&](double t) { return t < 5 ? 0.003 : -0.003; }}};
        std::string text = kind == "circle" ? "t_s,fx,fy,fz\n" : "t_s,fx,fz\n";
        for (double t = 0; t < 10; t += 0.002) {
            text += number(t) + "," + number(forces.at(kind)(t)) + ",";
            if (kind == "circle") text += number(0.4 * wave(0.5, t + 0.5)) + ",";
            text += number(1 + 0.005 * random.normal()) + "\n";
        }
        const std::string line = imported(text);
        QVERIFY2(!line.empty() && faultsOfDataset(m_out).empty(), line.c_str());
        if (kind == "slow vibration")
            QVERIFY2(contains(line, "check that the record is one stroke in one direction"), line.c_str());
    }

    void twoAxesAreJoinedAndOneKeepsItsSign()
    {
        const auto across = [](const WrittenSample& s) {
            return number(s.timeS) + "," + number(0.8 * (s.tangentialN + 0.08) + 0.03) + "," +
                   number(0.6 * (s.tangentialN + 0.08) - 0.05) + "," + number(-s.normalN);
        };
        const auto text = stroke_text::written({}, "t_s,fx,fy,fz", across);
        imported(text);
        QVERIFY(std::abs(meanOf(readFriction(readDataset(m_out), FabricId("F01"), 0).values) - 0.5) < 0.002);
        QVERIFY(saved()["axes"]["joined"].get<bool>());
        QVERIFY(saved()["axes"]["normal_turned"].get<bool>());  // fz is negative in compression.

        m_options.normal = ForceAxis{"fz", -1};
        m_options.tangential = {{"fx", -1}};
        const auto line = imported(text);
        QVERIFY(std::abs(meanOf(readFriction(readDataset(m_out), FabricId("F01"), 1).values) + 0.4) < 0.002);
        QVERIFY2(contains(line, "negative"), line.c_str());
        m_options.tangential = {{"fq", 1}};
        QVERIFY(contains(refusalOf([&] { imported(text); }), "fq"));
        m_options.tangential = {{"fx", 1}};
        m_options.normal = ForceAxis{"fz", 1};  // Against the load, so that no contact is left.
        QVERIFY(!refusalOf([&] { imported(text); }).empty());
    }

    void unitsAreDeclaredOrRefused()
    {
        Stroke grams;
        grams.unit = 1 / 9.80665e-3;
        m_options.forceUnit = "gf";
        imported(stroke_text::twoForces(grams));
        QVERIFY(std::abs(meanOf(readFriction(readDataset(m_out), FabricId("F01"), 0).values) - 0.5) < 0.002);
        QVERIFY(std::abs(saved()["zero"]["normal_n"].get<double>() - 0.12) < 0.002);
        // The unit in the header takes precedence over the option.
        Stroke milli;
        milli.unit = 1000;
        imported(stroke_text::twoForces(milli, "t_s,fn (mN),ft [mN]"));
        QVERIFY(std::abs(saved(1)["zero"]["normal_n"].get<double>() - 0.12) < 0.002);

        m_options.forceUnit.clear();
        QVERIFY(contains(refusalOf([&] { imported(stroke_text::twoForces(milli)); }), "--force-unit"));
        QVERIFY(contains(refusalOf([&] { imported(stroke_text::twoForces(milli, "t_s,fn (mN),ft [N]")); }),
                         "the mean coefficient is"));
        Stroke faint;
        faint.unit = 0.001;
        QVERIFY(contains(refusalOf([&] { imported(stroke_text::twoForces(faint)); }), "0.05 to 1000 N"));
        QVERIFY(contains(refusalOf([&] { imported(stroke_text::twoForces({}, "t_s,fn (stone),ft")); }), "stone"));
    }

    void contactThatIsLostForMomentsIsLeftOutAndForLongRefused()
    {
        Stroke moment;
        moment.lostFromS = 4;
        moment.lostToS = 4.02;
        const auto line = imported(stroke_text::twoForces(moment));
        QVERIFY2(contains(line, "samples with too little normal force left out"), line.c_str());
        QCOMPARE(saved()["left_out"]["samples"].get<int>(), 10);
        for (const double mu : readFriction(readDataset(m_out), FabricId("F01"), 0).values) QVERIFY(mu > 0.4 && mu < 0.6);
        Stroke often = moment;
        often.lostToS = 4.08;  // Bridged, but more than 1 % of the slide.
        m_options.trim = Selection::Stated;
        m_options.trimInterval = {3, 5};
        const auto refusal = refusalOf([&] { imported(stroke_text::twoForces(often)); });
        QVERIFY2(contains(refusal, "row ") && contains(refusal, "contact"), refusal.c_str());
    }

    void zeroNormalForceIsRefused()
    {
        QVERIFY(contains(refusalOf([&] { imported("t,normal,tangential\n0,0,1\n1,0,1\n2,0,1\n"); }), "0 N under load"));
    }

    /// A cable is out, or another column was named. Rendering and training refuse such a record later.
    void aSilentTangentialChannelIsRefused()
    {
        std::string zeros = "t_s,fn,ft\n", offset = zeros, coefficient = "t_s,mu\n", faint = zeros;
        for (int i = 0; i < 500; ++i) {
            const std::string time = number(i * 0.01) + ",";
            zeros += time + "3,0\n";
            offset += time + (i < 100 ? "0" : "3") + ",0.1\n";  // subtracting the zero leaves 1e-16 N
            coefficient += time + "0\n";
            faint += time + "3," + (i % 3 == 0 ? "0\n" : "0.0001\n");
        }
        for (const std::string& text : {zeros, offset}) {
            const std::string refusal = refusalOf([&] { imported(text); });
            QVERIFY2(contains(refusal, "the tangential force is 0 throughout") && contains(refusal, "Felt_1.csv") &&
                         contains(refusal, "--tangential"),
                     refusal.c_str());
        }
        QVERIFY(contains(refusalOf([&] { imported(coefficient); }), "the coefficient of friction is 0 throughout"));
        QVERIFY(!fs::exists(m_out));
        QVERIFY(contains(imported(faint), "is unusual"));
    }

    void unevenStampsAreResampledAtAStatedRate()
    {
        Stroke uneven;
        uneven.jitter = 1.2;
        imported(stroke_text::twoForces(uneven));
        QCOMPARE(saved()["resampling"]["method"].get<std::string>(), std::string("linear between neighbours"));
        QVERIFY(std::abs(meanOf(readFriction(readDataset(m_out), FabricId("F01"), 0).values) - 0.5) < 0.002);
        m_options.rateHz = 60;
        const auto line = imported(stroke_text::twoForces(uneven));
        QVERIFY2(contains(line, "60 Hz") && contains(line, "mean over each period"), line.c_str());
        QCOMPARE(saved(1)["resampling"]["method"].get<std::string>(), std::string("mean over each period"));
        const auto record = readFriction(readDataset(m_out), FabricId("F01"), 1);
        QVERIFY(std::abs(record.sampleRateHz - 60) < 1e-3);
    }

    void averagingLeavesOutWhatTheRateCannotHold()
    {
        // At 60 samples per second a wave of 180 Hz would be aliased to a constant.
        std::string text = "t_s,mu\n";
        for (int i = 0; i < 3000; ++i)
            text += number(i / 600.0) + "," + number(0.5 + 0.2 * std::cos(2 * std::numbers::pi * 180 * i / 600.0)) + "\n";
        m_options.rateHz = 60;
        m_options.trim = Selection::None;
        imported(text);
        for (const double mu : readFriction(readDataset(m_out), FabricId("F01"), 0).values) QVERIFY(std::abs(mu - 0.5) < 0.11);
    }

    void trimmingMayBeStatedOrLeft()
    {
        m_options.trim = Selection::Stated;
        m_options.trimInterval = {2, 4};
        imported(stroke_text::twoForces());
        QCOMPARE(readFriction(readDataset(m_out), FabricId("F01"), 0).values.size(), std::size_t(1001));
        m_options.trim = Selection::None;
        QVERIFY(contains(refusalOf([&] { imported(stroke_text::twoForces()); }), "contact"));  // Rest is not contact.
    }

    void aGratingIsNotTakenForBreakaways()
    {
        Stroke grating;
        grating.texture = 0.3;
        imported(stroke_text::twoForces(grating));
        const double from = saved()["slide"]["from_s"], to = saved()["slide"]["to_s"];
        QVERIFY2(from > 0.8 && from < 1.5 && to > 7.3 && to < 7.9, std::to_string(from).c_str());
    }

    void theProcessingIsShownInAPicture()
    {
        m_plots = pathOf(*m_folder) / "plots";
        imported(stroke_text::twoForces());
        const std::string svg = read(m_plots / "F01-000.svg");
        for (const char* part :
             {"<svg", "steady slide, kept", "unloaded", "breakaway", "(dashed), sd 0.0", "coefficient of friction"})
            QVERIFY2(contains(svg, part), part);
        QVERIFY(!contains(svg, "nan") && !contains(svg, "inf"));
        QVERIFY(svg.size() < 200000);
    }

    void aRefusedRecordLeavesNoPicture()
    {
        m_plots = pathOf(*m_folder) / "plots";
        write(m_in / "Felt_2.csv", "t,normal,tangential\n0,5,1\n1,x,1\n");
        QVERIFY(!refusalOf([&] { imported(stroke_text::twoForces()); }).empty());
        QVERIFY(!fs::exists(m_plots) && !fs::exists(m_out));
    }

    void oneSampleIsRefusedByName()
    {
        for (const char* text : {"t,mu\n0,0.1\n", "t,normal,tangential\n0,5,1\n"})
            QVERIFY(contains(refusalOf([&] { imported(text); }), "has 1 rows"));
    }

    /// The check of a data set calls such a record a fault.
    void aRecordTooShortForAnImageIsReported()
    {
        m_options.trim = Selection::None;
        std::string text = "t_s,mu\n";
        for (int i = 0; i < 7; ++i) text += number(i * 0.01) + "," + number(0.3 + 0.01 * (i % 2)) + "\n";
        const auto line = imported(text);
        QVERIFY2(contains(line, "warning: the record has only 7 samples; a friction image needs 8"), line.c_str());
        QVERIFY(contains(saved()["warnings"].dump(), "only 7 samples"));
        fs::remove_all(m_out);
        QVERIFY(!contains(imported(text + "0.07,0.3\n"), "samples; a friction image needs"));
    }

    void manySamplesAreTaken()
    {
        Stroke fast;
        fast.rateHz = 60000;  // 540 000 rows.
        const auto line = imported(stroke_text::twoForces(fast));
        QVERIFY2(contains(line, "breakaway"), line.c_str());
        QVERIFY(std::abs(saved()["mean"].get<double>() - 0.5) < 0.002);
    }

    /// Found by reader_fuzz_test: these bytes made invalid JSON.
    void namesInLatin1BecomeReadable()
    {
        m_plots = pathOf(*m_folder) / "plots";
        const auto line = imported("Time [ms];Fn (mN)\xB5;Fx (mN);Fy (mN)\n0;500;3;4\n10;510;3;4\n25;520;-3;4\n");
        QVERIFY2(contains(line, "Fn (mN)\xC2\xB5"), line.c_str());
        QVERIFY(contains(saved()["meaning"].get<std::string>(), "\xC2\xB5"));
    }

    void anAddedFabricIsReported()
    {
        write(m_in / "Felt_1.csv", "t,mu\n0,0.1\n1,0.2\n");
        const auto first = importRecordings({ImportKind::FrictionCsv, {m_in}, m_out, {}, {}});
        QCOMPARE(first.size(), std::size_t(1));
        write(m_in / "Wool_1.csv", "t,mu\n0,0.1\n1,0.2\n");
        const auto second = importRecordings({ImportKind::FrictionCsv, {m_in / "Wool_1.csv"}, m_out, {}, {}});
        QVERIFY2(contains(second.back(), "2 fabrics now (before: 1)") && contains(second.back(), "range"), second.back().c_str());
    }

    void optionsAreReadAsTyped()
    {
        TimeInterval interval;
        QVERIFY(selectionFrom("auto", "--zero", interval) == Selection::Automatic);
        QVERIFY(selectionFrom("none", "--zero", interval) == Selection::None);
        QVERIFY(selectionFrom("0.5,1e1", "--zero", interval) == Selection::Stated);
        QVERIFY(interval == (TimeInterval{0.5, 10}));
        for (const char* wrong : {"1", "2,1", "-1,2", "a,b", "1,2,3", ","})
            QVERIFY2(contains(refusalOf([&] { selectionFrom(wrong, "--trim", interval); }), "--trim"), wrong);
        QVERIFY(axesFrom("-fz", "--normal", 1) == (std::vector<ForceAxis>{{"fz", -1}}));
        QVERIFY(axesFrom("fx,-fy", "--tangential", 2) == (std::vector<ForceAxis>{{"fx", 1}, {"fy", -1}}));
        QVERIFY(axesFrom("", "--tangential", 2).empty());
        for (const char* wrong : {"-", "fx,", ",fx", "fx,fy,fz", ","})
            QVERIFY2(contains(refusalOf([&] { axesFrom(wrong, "--tangential", 2); }), "--tangential"), wrong);
        QCOMPARE(newtonsIn("MN"), std::optional(1e-3));
        QCOMPARE(newtonsIn("Newtons"), std::optional(1.0));
        QVERIFY(!newtonsIn("stone"));
    }

private:
    /// Imports `text` as a stroke of Felt and returns the line that reports it.
    std::string imported(const std::string& text)
    {
        write(m_in / "Felt_1.csv", text);
        ImportRequest request{ImportKind::FrictionCsv, {m_in}, m_out, {}, {}};
        request.friction = m_options;
        request.plots = m_plots;
        return importRecordings(request).front();
    }

    nlohmann::json saved(int index = 0) const
    {
        return nlohmann::json::parse(read(m_out / ("F01/friction/00" + std::to_string(index) + ".json")));
    }

    FrictionOptions m_options;
    std::unique_ptr<QTemporaryDir> m_folder;
    fs::path m_in, m_out, m_plots;
};

QTEST_GUILESS_MAIN(FrictionImportTest)
#include "friction_import_test.moc"
