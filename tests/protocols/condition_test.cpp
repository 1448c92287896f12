#include "protocols/condition.h"

#include <QTest>
#include <algorithm>

#include "protocols/files/errors.h"

using namespace protocols;

class ConditionTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void nineConditionsInTheOrderOfThePaper()
    {
        QStringList ids;
        for (const ConditionId& id : conditionList("all")) ids << QString::fromStdString(id.value);
        QCOMPARE(ids.join(' '), QString("v_grey v_shape f_g h_g h_g&f_g t_grey f h h&f"));
    }

    void otherConditionsFollowAndMustBeNamed()
    {
        const auto all = allConditions();
        QCOMPARE(all.size(), std::size_t{10});
        for (std::size_t i = 0; i < all.size(); ++i) QCOMPARE(all[i].ofThePaper, i < 9);
        QCOMPARE(conditionList("gradient,h"), (std::vector<ConditionId>{ConditionId("gradient"), ConditionId("h")}));
    }

    void groupsFollowTheSignals()
    {
        for (const Condition& condition : allConditions()) {
            const bool generated =
                condition.relief == ReliefSource::GeneratedHeight || condition.friction == FrictionSource::GeneratedTrace;
            QCOMPARE(condition.group == ConditionGroup::Generated, generated);
            QVERIFY(condition.relief != ReliefSource::None || condition.friction != FrictionSource::None);
        }
    }

    void bothSpellingsNameTheSameCondition()
    {
        QCOMPARE(&conditionNamed("h_g+f_g"), &conditionNamed("h_g&f_g"));
        QCOMPARE(fileNameOf(ConditionId("h_g&f_g")), std::string("h_g+f_g"));
        QCOMPARE(fileNameOf(ConditionId("v_grey")), std::string("v_grey"));
    }

    void listsAreReadInTheirOrder()
    {
        QCOMPARE(conditionList("h+f,v_grey"), (std::vector<ConditionId>{ConditionId("h&f"), ConditionId("v_grey")}));
        QCOMPARE(conditionList("all").size(), std::size_t{9});
    }

    void wrongListsAreRefusedByName_data()
    {
        QTest::addColumn<QString>("list");
        QTest::addColumn<QString>("named");
        QTest::newRow("unknown") << "v_grey,velvet"
                                 << "'velvet'";
        QTest::newRow("doubled in two spellings") << "h&f,h+f"
                                                  << "'h&f'";
        QTest::newRow("empty") << ""
                               << "''";
        QTest::newRow("trailing comma") << "f,"
                                        << "''";
        QTest::newRow("capital letters") << "V_GREY"
                                         << "'V_GREY'";
    }

    void wrongListsAreRefusedByName()
    {
        QFETCH(const QString, list);
        QFETCH(const QString, named);
        try {
            conditionList(list.toStdString());
            QFAIL("a wrong list was accepted");
        } catch (const Error& error) {
            QCOMPARE(error.exitCode(), ExitCode::BadInput);
            QVERIFY2(QString(error.what()).contains(named), error.what());
        }
    }

    void aConditionMayCarryAQuality()
    {
        QCOMPARE(&conditionNamed("h_g@fast"), &conditionNamed("h_g"));
        QCOMPARE(&conditionNamed("h_g+f_g@accurate"), &conditionNamed("h_g&f_g"));
        QCOMPARE(qualityOf(ConditionId("h_g@balanced")), std::optional(Quality::Balanced));
        QCOMPARE(qualityOf(ConditionId("h_g")), std::optional<Quality>());
        QCOMPARE(conditionIdFrom("h_g+f_g@fast"), ConditionId("h_g&f_g@fast"));
        QCOMPARE(fileNameOf(ConditionId("h_g&f_g@fast")), std::string("h_g+f_g@fast"));
        QCOMPARE(conditionList("h_g,h_g@balanced,v_shape@fast"),
                 (std::vector<ConditionId>{ConditionId("h_g"), ConditionId("h_g@balanced"), ConditionId("v_shape@fast")}));
    }

    void qualitiesFollowTheOrderOfThePaper()
    {
        auto ids = conditionList("h@fast,h_g@accurate,v_grey,h_g@fast,h_g@balanced,h_g,v_shape@accurate");
        std::ranges::sort(ids, comesBefore);
        QStringList order;
        for (const ConditionId& id : ids) order << QString::fromStdString(id.value);
        QCOMPARE(order.join(' '), QString("v_grey v_shape@accurate h_g h_g@fast h_g@balanced h_g@accurate h@fast"));
    }

    void wrongQualitiesAreRefusedByName_data()
    {
        QTest::addColumn<QString>("list");
        QTest::addColumn<QString>("named");
        QTest::newRow("unknown") << "h_g@quick"
                                 << "unknown quality 'quick' in 'h_g@quick'";
        QTest::newRow("empty") << "h_g@"
                               << "unknown quality '' in 'h_g@'";
        QTest::newRow("two") << "h_g@fast@fast"
                             << "unknown quality 'fast@fast'";
        QTest::newRow("capital letters") << "h_g@Fast"
                                         << "unknown quality 'Fast'";
        QTest::newRow("of a grey frame") << "t_grey@fast"
                                         << "'t_grey@fast' has a quality, which changes nothing of t_grey; expected 't_grey'";
        QTest::newRow("of a measured trace") << "f@accurate"
                                             << "which changes nothing of f";
        QTest::newRow("of an unknown condition") << "velvet@fast"
                                                 << "unknown condition 'velvet@fast'";
        QTest::newRow("doubled") << "h_g+f_g@fast,h_g&f_g@fast"
                                 << "'h_g&f_g@fast' is named twice";
        QTest::newRow("of all") << "all@fast"
                                << "unknown condition 'all@fast'";
    }

    void wrongQualitiesAreRefusedByName()
    {
        QFETCH(const QString, list);
        QFETCH(const QString, named);
        try {
            conditionList(list.toStdString());
            QFAIL("a wrong quality was accepted");
        } catch (const Error& error) {
            QCOMPARE(error.exitCode(), ExitCode::BadInput);
            QVERIFY2(QString(error.what()).contains(named), error.what());
        }
    }

    void refusalNamesTheKnownIds()
    {
        try {
            conditionNamed("silk");
            QFAIL("the unknown condition silk was accepted");
        } catch (const Error& error) {
            for (const Condition& condition : allConditions())
                QVERIFY(QString(error.what()).contains(QString::fromStdString(std::string(condition.id))));
        }
    }
};

QTEST_GUILESS_MAIN(ConditionTest)
#include "condition_test.moc"
