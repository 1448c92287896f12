#include "study/app/pages/editor/check_panel.h"

#include <QRegularExpression>
#include <QVBoxLayout>
#include <cmath>
#include <optional>
#include <string_view>

#include "study/app/language/app_text.h"
#include "study/app/language/below.h"
#include "study/app/pages/editor/draft_fields.h"
#include "study/app/pages/editor/page_preview.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

/// What is wrong, in words of the page where the file has a key for it, else in those of the check.
QString whatIsWrong(const QString& said)
{
    static const QRegularExpression withoutText(QStringLiteral("^'(.*)' has no text, expected one in question_texts$"));
    static const QRegularExpression rightAnswers(QStringLiteral("^(\\d+) questions with a right answer, expected one"));
    if (const auto found = withoutText.match(said); found.hasMatch())
        return CheckPanel::tr("“%1” has no sentence").arg(found.captured(1));
    if (const auto found = rightAnswers.match(said); found.hasMatch())
        return CheckPanel::tr("%1 questions have a right answer, expected one; others can be answered in own words")
            .arg(found.captured(1));
    return inOwnLanguage(said);
}

constexpr std::size_t mostFaults = 40;

constexpr std::string_view unknownKey = ": unknown key '";

/// A key that no protocol has, and the place of its object: "" for the protocol.
struct UnknownKey {
    std::string object, key;
};

/// None where the fault is another one. The key may hold quotes, brackets and points.
std::optional<UnknownKey> unknownKeyIn(const protocols::ProtocolFault& fault)
{
    const std::size_t at = fault.text.find(unknownKey), from = at + unknownKey.size();
    if (at == std::string::npos || !fault.text.ends_with('\'') || fault.text.size() <= from) return std::nullopt;
    std::string object = fault.text.substr(0, at);
    if (object == "the protocol") object.clear();
    return UnknownKey{object, fault.text.substr(from, fault.text.size() - 1 - from)};
}

/// The key between the last quotes.
std::string quotedKeyIn(const std::string& text)
{
    const std::size_t end = text.rfind('\'');
    const std::size_t begin = end == std::string::npos || end == 0 ? end : text.rfind('\'', end - 1);
    return begin == std::string::npos ? std::string() : text.substr(begin + 1, end - begin - 1);
}

/// The place of a fault, which begins with it: "phases[0].scale.max: …"; of a missing or unknown key its own place.
std::string placeIn(const protocols::ProtocolFault& fault)
{
    if (const auto unknown = unknownKeyIn(fault)) {
        // A key with brackets or points would look like the place of another value.
        const bool isPlain = unknown->key.find_first_of("[].") == std::string::npos;
        return unknown->object + (unknown->object.empty() ? "" : ".") + (isPlain ? unknown->key : "?");
    }
    std::string place = fault.text.substr(0, fault.text.find(": "));
    if (place == "the protocol") place.clear();
    if (!fault.text.ends_with("' is missing")) return place;
    return place + (place.empty() ? "" : ".") + quotedKeyIn(fault.text);
}

/// "true slots per condition, Q1": what is balanced, and the question.
QString nameOfRange(const std::string& what)
{
    const QString english = QString::fromStdString(what);
    const qsizetype comma = english.indexOf(QStringLiteral(", "));
    if (comma < 0) return inOwnLanguage(english);
    return CheckPanel::tr("%1, %2").arg(inOwnLanguage(english.left(comma)), english.mid(comma + 2));
}

QString decimal(double value) { return QString::number(value, 'f', 2).replace(QLatin1Char('.'), decimalMark()); }

}  // namespace

CheckPanel::CheckPanel(DraftFields& fields, LookAhead lookAhead, QWidget* parent)
    : QWidget(parent),
      m_fields(fields),
      m_lookAhead(std::move(lookAhead)),
      m_state(label("checkState", Type::Body, this, Weight::Bold)),
      m_rows(new QVBoxLayout),
      m_numbers(label("sessionNumbers", Type::Plain, this)),
      m_detects(label("detectableEffects", Type::Plain, this)),
      m_balance(quietLabel("possibleBalance", this, Type::Plain)),
      m_preview(new PagePreview(this))
{
    setObjectName("checkPanel");
    auto* column = new QVBoxLayout(this);
    column->setSpacing(8);
    column->addWidget(m_state);
    m_rows->setSpacing(6);
    column->addLayout(m_rows);
    column->addWidget(m_numbers);
    column->addWidget(m_preview);
    column->addWidget(m_detects);
    column->addWidget(m_balance);
    column->addStretch(1);
}

void CheckPanel::present(const protocols::CheckedProtocol& checked, int phase, bool hasLines)
{
    m_faults = checked.faults;
    m_protocol = checked.protocol;
    m_hasLines = hasLines;
    showFaults();
    showNumbers();
    // While a word is being typed, the last sound pages stay.
    if (m_protocol) m_preview->present(m_protocol, phase);
    beginOutlook();
}

void CheckPanel::clear() { m_preview->present(std::nullopt, 0); }

QString CheckPanel::wordsOf(const protocols::ProtocolFault& fault) const
{
    const QString english = QString::fromStdString(fault.text);
    const qsizetype colon = english.indexOf(QStringLiteral(": "));
    const DraftFields::Bound* bound = m_fields.boundAt(placeIn(fault));
    // The caption of the control stands for the place in the file.
    const QString where = bound ? bound->caption : english.left(colon);
    const QString said = colon < 0 ? english : english.mid(colon + 2);
    const bool isField = bound && bound->place == placeIn(fault);
    const bool isEmpty = said.endsWith(QStringLiteral("' is missing")) || said.startsWith(QStringLiteral("\"\", expected"));
    const QString text = isField && isEmpty                                                    ? tr("%1 is missing").arg(where)
                         : isField && said.startsWith(QStringLiteral("a list of 0, expected")) ? tr("%1: none yet").arg(where)
                         : colon < 0                                                           ? inOwnLanguage(said)
                                     : tr("%1: %2").arg(where, whatIsWrong(said));
    return m_hasLines ? tr("Line %1, column %2. %3").arg(fault.line).arg(fault.column).arg(text) : text;
}

void CheckPanel::showFaults()
{
    QStringList all;
    for (const protocols::ProtocolFault& fault : m_faults) all << wordsOf(fault);
    const std::size_t count = m_faults.size();
    m_state->setText(count == 0 ? tr("No fault") : count == 1 ? tr("1 fault") : tr("%1 faults").arg(count));
    if (all == m_shown) return;  // the button that has the focus stays
    m_shown = all;
    clearLayout(*m_rows);
    for (std::size_t i = 0; i < std::min(count, mostFaults); ++i) {
        auto* row = new QWidget(this);
        auto* line = new QHBoxLayout(row);
        line->setContentsMargins(0, 0, 0, 0);
        line->setSpacing(8);
        const QString& words = all[static_cast<qsizetype>(i)];
        QLabel* text = label(qPrintable(QStringLiteral("fault%1").arg(i + 1)), Type::Plain, row);
        setRole(*text, "hint");
        text->setText(words);
        // The sentence of a question stands beside its name; a key that no protocol has can only be removed.
        const bool isSentence = m_faults[i].text.find("has no text") != std::string::npos;
        const auto unknown = unknownKeyIn(m_faults[i]);
        const QString place = QString::fromStdString(placeIn(m_faults[i]) + (isSentence ? ".text" : ""));
        auto* go = button(qPrintable(QStringLiteral("goToFault%1").arg(i + 1)), unknown ? tr("Remove it") : tr("Go to"), row);
        setType(*go, Type::Plain);
        go->setAccessibleName(unknown ? tr("Remove it: %1").arg(words) : tr("Go to: %1").arg(words));
        connect(go, &QPushButton::clicked, this, [this, place, unknown] {
            if (unknown)
                Q_EMIT removeRequested(QString::fromStdString(unknown->object), QString::fromStdString(unknown->key));
            else
                Q_EMIT jumpRequested(place);
        });
        line->addWidget(text, 1);
        line->addWidget(go, 0, Qt::AlignTop);
        m_rows->addWidget(row);
    }
    if (count <= mostFaults) return;
    QLabel* more = quietLabel("moreFaults", this, Type::Plain);
    more->setText(tr("… and %1 more").arg(count - mostFaults));
    m_rows->addWidget(more);
}

QString CheckPanel::summary() const
{
    if (!m_protocol) return m_state->text();
    return tr("No fault. Presentations: %1, minutes: %2, sittings: %3")
        .arg(m_protocol->presentations())
        .arg(std::lround(m_protocol->minutesPerParticipant()))
        .arg(m_protocol->sittingsPerParticipant());
}

void CheckPanel::showNumbers()
{
    if (!m_protocol) {
        showText(*m_numbers, tr("Minutes, power and the preview follow when there is no fault."));
        return;
    }
    const protocols::Protocol& p = *m_protocol;
    showText(*m_numbers, tr("Each participant: about %1 minutes without breaks. Presentations: %2, answers: %3, breaks: %4, "
                            "sittings: %5. The whole study: answers: %6.")
                             .arg(std::lround(p.minutesPerParticipant()))
                             .arg(p.presentations())
                             .arg(p.answersPerParticipant())
                             .arg(p.breaks())
                             .arg(p.sittingsPerParticipant())
                             .arg(static_cast<qint64>(p.answersPerParticipant()) * p.participants));
}

void CheckPanel::beginOutlook()
{
    if (!m_protocol || !m_lookAhead) {
        showText(*m_detects, {});
        showText(*m_balance, {});
        m_computed.reset();
        return;
    }
    // A running computation cannot be stopped; its end begins the next.
    if (m_computed == m_protocol || m_work.isBusy()) return;
    m_computed = m_protocol;
    showText(*m_detects, tr("Power and balance are being computed …"));
    showText(*m_balance, {});
    m_work.run(
        [this, protocol = *m_protocol, lookAhead = m_lookAhead](const std::atomic<bool>&) -> InBackground::Then {
            return [this, outlook = lookAhead(protocol)] {
                showOutlook(outlook);
                beginOutlook();
            };
        },
        [this](const QString& why) {
            showText(*m_detects, why);
            beginOutlook();
        });
}

void CheckPanel::showOutlook(const SessionOutlook& outlook)
{
    QStringList lines;
    for (const SessionOutlook::Detectable& one : outlook.detects) {
        const QString question = QString::fromStdString(one.question);
        if (!one.smallest)
            lines << tr("%1: %2").arg(question, QString::fromStdString(one.why));
        else if (one.isOfRatings)
            lines << tr("%1: a difference of %2 scale points between two conditions").arg(question, decimal(*one.smallest));
        else
            lines << tr("%1: %2 % right answers in one condition").arg(question).arg(std::lround(*one.smallest * 100));
    }
    if (!lines.isEmpty()) lines.prepend(tr("With a power of 80 %, under the usual assumptions, the study detects:"));
    showText(*m_detects, lines.join(QLatin1Char('\n')));
    QStringList balance;
    for (const SessionOutlook::Range& range : outlook.balance)
        balance << (range.least == range.most ? tr("%1: %2").arg(nameOfRange(range.what)).arg(range.least)
                                              : tr("%1: %2 to %3").arg(nameOfRange(range.what)).arg(range.least).arg(range.most));
    if (!balance.isEmpty()) balance.prepend(tr("Balance of the running orders:"));
    if (!outlook.isBalanceDrawn)
        balance << tr("Orders of this length take long to draw; `vis2hap protocol show` prints their balance.");
    showText(*m_balance, balance.join(QLatin1Char('\n')));
}

}  // namespace study::app
