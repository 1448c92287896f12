#include "rendering/composition/plan.h"

#include <QTest>
#include <algorithm>

using namespace rendering;

namespace {

QString namesOf(const std::vector<Signal>& signals)
{
    QStringList names;
    for (const Signal signal : signals) names << QString::fromStdString(nameOf(signal));
    return names.join(", ");
}

}  // namespace

class PlanTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void conditionNeedsItsSignalsAndNoOthers_data()
    {
        QTest::addColumn<QString>("condition");
        QTest::addColumn<QString>("signalNames");
        QTest::addColumn<bool>("generators");
        QTest::newRow("v_grey") << "v_grey"
                                << "photograph, grey photograph" << false;
        QTest::newRow("v_shape") << "v_shape"
                                 << "photograph, shape from shading" << false;
        QTest::newRow("f_g") << "f_g"
                             << "photograph, generated spectrogram, generated trace" << true;
        QTest::newRow("h_g") << "h_g"
                             << "photograph, generated height" << true;
        QTest::newRow("h_g&f_g") << "h_g&f_g"
                                 << "photograph, generated height, generated spectrogram, generated trace" << true;
        QTest::newRow("t_grey") << "t_grey"
                                << "tactile frame, grey tactile frame" << false;
        QTest::newRow("f") << "f"
                           << "friction record, measured trace" << false;
        QTest::newRow("h") << "h"
                           << "tactile frame, photometric height" << false;
        QTest::newRow("h&f") << "h&f"
                             << "tactile frame, friction record, photometric height, measured trace" << false;
        QTest::newRow("gradient") << "gradient"
                                  << "tactile frame, photometric height, gradient of the height" << false;
    }
    void conditionNeedsItsSignalsAndNoOthers()
    {
        QFETCH(QString, condition);
        QFETCH(QString, signalNames);
        QFETCH(bool, generators);
        const auto signals = signalsFor(protocols::conditionNamed(condition.toStdString()));
        QCOMPARE(namesOf(signals), signalNames);
        QCOMPARE(needsGenerators(signals), generators);
    }

    void everyConditionHasARow()
    {
        for (const auto& condition : protocols::allConditions()) QVERIFY(!signalsFor(condition).empty());
    }

    void aQualityChangesTheConditionsWhoseSignalsDependOnIt()
    {
        for (const auto& condition : protocols::allConditions()) {
            const auto signals = signalsFor(condition);
            QCOMPARE(std::ranges::any_of(signals, dependsOnQuality), condition.hasQuality());
        }
        QVERIFY(explain(protocols::conditionList("h_g@fast,h")).starts_with("h_g@fast   photograph, generated height"));
    }

    void severalConditionsShareTheirSignals()
    {
        const auto conditions = protocols::conditionList("v_grey,h,h&f");
        QCOMPARE(namesOf(signalsFor(conditions)),
                 "photograph, tactile frame, friction record, grey photograph, photometric height, measured trace");
    }

    void explanationStatesWhoNeedsTheGenerators()
    {
        const auto lines = QString::fromStdString(explain(protocols::conditionList("h,h_g+f_g"))).split('\n');
        QVERIFY(lines[0].startsWith("h ") && lines[0].contains("tactile frame, photometric height") &&
                lines[0].contains("no libtorch"));
        QVERIFY(lines[1].startsWith("h_g&f_g ") && lines[1].contains("generated trace") && lines[1].contains("[generators"));
        QVERIFY(explain(protocols::conditionList("v_grey,f")).ends_with("libtorch is not needed\n"));
    }
};

QTEST_GUILESS_MAIN(PlanTest)
#include "plan_test.moc"
