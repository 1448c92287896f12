// A control is fair where nothing but the losses differs from the training of the model.
#include "rendering/models/fair_control.h"

#include <QTest>
#include <map>

using namespace rendering::models;

namespace {

ModelCardFields trained(int steps)
{
    ModelCardFields card;
    card.summary.trainingCommand = "vis2hap train cloths --out m.safetensors --steps " + std::to_string(steps);
    card.steps = steps;
    card.seed = 7;
    card.splitSeed = 3;
    card.datasetHash = "aa";
    card.heldOut = {"F05", "F02"};
    return card;
}

}  // namespace

class FairControlTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void sameTrainingWithOtherLossesIsFair()
    {
        ModelCardFields control = trained(6000);
        control.objective = "l1-only";
        control.seed = 8;
        control.bestStep = 12;
        control.heldOut = {"F02", "F05"};
        control.summary.trainingCommand += " --batch 8 --l1-only";  // the default, named
        QVERIFY(trainingDifferences(trained(6000), control).empty());
    }

    void everyDifferenceIsNamed_data()
    {
        QTest::addColumn<QString>("what");
        for (const char* what : {"800 steps (the model: 6,000)", "another data set", "another split", "other fabrics held out",
                                 "another width of the networks", "another crop", "another batch", "another learning rate",
                                 "another model to start from"})
            QTest::newRow(what) << what;
    }

    void everyDifferenceIsNamed()
    {
        QFETCH(QString, what);
        ModelCardFields control = trained(6000);
        const std::map<QString, std::function<void()>> changes{
            {"800 steps (the model: 6,000)", [&] { control.steps = 800; }},
            {"another data set", [&] { control.datasetHash = "bb"; }},
            {"another split", [&] { control.splitSeed = 4; }},
            {"other fabrics held out", [&] { control.heldOut.clear(); }},
            {"another width of the networks", [&] { control.architecture.baseChannels += 1; }},
            {"another crop", [&] { control.architecture.crop *= 2; }},
            {"another batch", [&] { control.summary.trainingCommand += " --batch 4"; }},
            {"another learning rate", [&] { control.summary.trainingCommand += " --learning-rate 0.01"; }},
            {"another model to start from", [&] { control.fromHash = "cc"; }}};
        changes.at(what)();
        QCOMPARE(trainingDifferences(trained(6000), control), std::vector<std::string>{what.toStdString()});
    }

    void optionsOfAControlRepeatTheTraining()
    {
        ModelCardFields model = trained(6000);
        model.split = "sample";
        model.summary.trainingCommand += " --batch 4";
        const auto list = controlOptions(model);
        std::map<std::string, std::string> options(list.begin(), list.end());
        QCOMPARE(options.at("--steps"), std::string("6000"));
        QCOMPARE(options.at("--seed"), std::string("7"));
        QCOMPARE(options.at("--split"), std::string("sample"));
        QCOMPARE(options.at("--split-seed"), std::string("3"));
        QCOMPARE(options.at("--hold-out"), std::string("F02,F05"));
        QCOMPARE(options.at("--batch"), std::string("4"));
        QVERIFY(options.contains("--l1-only") && !options.contains("--learning-rate"));
        QVERIFY(std::stoi(options.at("--patience")) >= 6000 / 250);  // no early stop: a validation every 250 steps
    }

    /// The learning rate falls over all steps that were asked for, also where the model stopped before them.
    void aControlOfAnEarlyStopStopsThere()
    {
        ModelCardFields model = trained(6000), control = trained(6000);
        model.steps = control.steps = 4000;
        model.summary.trainingCommand += " --validate-every 100";
        const auto list = controlOptions(model);
        std::map<std::string, std::string> options(list.begin(), list.end());
        QCOMPARE(options.at("--steps"), std::string("6000"));
        QCOMPARE(options.at("--stop-at"), std::string("4000"));
        QCOMPARE(options.at("--validate-every"), std::string("100"));
        control.summary.trainingCommand = "vis2hap train cloths --out c.safetensors --steps 4000 --validate-every 100";
        QCOMPARE(trainingDifferences(model, control),
                 std::vector<std::string>{"a learning rate that falls over 4,000 steps (the model: 6,000)"});
        model.summary.trainingCommand = "vis2hap train cloths --out m.safetensors --minutes 30";
        model.trainingMinutes = 20;
        const auto timed = controlOptions(model);
        options = {timed.begin(), timed.end()};
        QCOMPARE(options.at("--steps"), std::string("6000"));
        for (const auto& [name, value] : controlOptions(trained(6000))) QVERIFY(name != "--stop-at");
    }

    /// Networks for any cloth train on drawn fabrics, without a split and to the last step, at twice the usual learning rate.
    void controlOfDrawnFabricsNeedsNoSplit()
    {
        ModelCardFields model = trained(2500), control = trained(2500);
        model.architecture.sees = control.architecture.sees = true;
        control.summary.trainingCommand += " --learning-rate 0.002 --l1-only";
        QVERIFY(trainingDifferences(model, control).empty());
        QCOMPARE(trainingDifferences(trained(2500), control),
                 (std::vector<std::string>{"other networks", "another learning rate"}));
        const auto list = controlOptions(control);
        const std::map<std::string, std::string> options(list.begin(), list.end());
        QCOMPARE(options.at("--steps"), std::string("2500"));
        for (const char* none : {"--split", "--split-seed", "--patience", "--learning-rate"}) QVERIFY(!options.contains(none));
    }
};

QTEST_GUILESS_MAIN(FairControlTest)
#include "fair_control_test.moc"
