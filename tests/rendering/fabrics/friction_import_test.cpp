// Import of friction records: zero, axes, units, the steady slide and even steps. Everything that the import did is
// reported and saved.
#include <cmath>
#include <functional>
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
        QVERIFY2(contains(line, "the whole record is the slide"), line.c_str());
        QCOMPARE(readFriction(readDataset(m_out), FabricId("F01"), 0).values.size(), std::size_t(400));
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
