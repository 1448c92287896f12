#include "study/app/pages/editor/page_preview.h"

#include <QComboBox>
#include <QCoreApplication>
#include <QEvent>
#include <QLabel>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

#include "protocols/usual_texts.h"
#include "study/app/pages/editor/draft_fields.h"
#include "study/app/pages/stage_stack.h"
#include "study/app/participant/instruction_view.h"
#include "study/app/participant/participant_side.h"
#include "study/app/pieces/page_fit.h"
#include "study/app/pieces/pieces.h"
#include "study/app/state/appearance.h"
#include "study/participant/session/present_instruction.h"

namespace study::app {

namespace {

using namespace session;
using protocols::Protocol;

constexpr QSize pageSize(900, 560);

/// The first lines; a picture shows no more.
QStringList firstOf(const std::vector<std::string>& texts)
{
    constexpr std::size_t most = 20;
    QStringList list;
    for (std::size_t i = 0; i < std::min(texts.size(), most); ++i) list << QString::fromStdString(texts[i]);
    return list;
}

SessionFacts factsOf(const Protocol& protocol)
{
    SessionFacts facts;
    facts.participant = QStringLiteral("P01");
    facts.consent = QString::fromStdString(protocol.consent);
    facts.facts = firstOf(protocol.facts);
    facts.checklist = firstOf(protocol.checklist);
    facts.readings = firstOf(protocol.readings);
    facts.strokeWords = QString::fromStdString(protocol.strokeWords);
    if (const auto* scale = memorisedScaleOf(protocol)) facts.scale = *scale;
    facts.sittingMinutes = protocol.sittingMinutes;
    facts.secondEntry = protocol.secondEntry;
    facts.confirmPieces = protocol.confirmPieces;
    for (const auto& [key, text] : protocols::usualParticipantTexts()) facts.said[key] = participantText(protocol, key);
    facts.hasOwnLowEnd = hasOwnText(protocol, "card_low", "scale_low");
    facts.hasOwnHighEnd = hasOwnText(protocol, "card_high", "scale_high");
    return facts;
}

/// A session in the middle of a phase, with invented codes.
View viewOf(const Protocol& protocol, int phase, const Stage& stage)
{
    View view;
    view.state.stage = stage;
    view.participant = "P01";
    view.presentations = protocol.presentations();
    view.presentation = 1;
    view.answersInAll = protocol.answersPerParticipant();
    view.minutesLeft = protocol.minutesPerParticipant();
    if (const auto* scale = memorisedScaleOf(protocol))
        view.placeToName = protocols::Tenths{scale->min.value +
                                             (scale->max.value - scale->min.value) / scale->step.value / 2 * scale->step.value};
    if (phase < 0) return view;
    const protocols::Phase& shown = protocol.phases.at(static_cast<std::size_t>(phase));
    constexpr int codes[] = {427, 183, 906};
    for (int piece = 0; piece < protocols::piecesOnTray(shown.task); ++piece) {
        view.tray.push_back(std::to_string(piece < 3 ? codes[piece] : 210 + 37 * piece));
        view.trayIds.emplace_back("F" + std::to_string(piece));
    }
    view.code = protocols::PresentationCode("K7QX");
    const auto* asked = std::get_if<Presenting>(&stage);
    view.question = shown.questions.at(static_cast<std::size_t>(asked ? asked->question : 0));
    if (!shown.instructions.empty()) view.instruction = shown.instructions.front();
    view.instructionBegins = true;
    return view;
}

/// The picture of the pages as a window shows them. Pages fit their text to their room only while they are shown.
QPixmap grabbedAsShown(QWidget& pages)
{
    pages.setAttribute(Qt::WA_DontShowOnScreen);
    pages.setAttribute(Qt::WA_ShowWithoutActivating);
    pages.show();
    for (PageFit* fit : pages.findChildren<PageFit*>()) QCoreApplication::sendPostedEvents(fit, QEvent::MetaCall);
    pages.hide();  // a picture of hidden pages begins with their layouts
    return pages.grab();
}

/// The scroll area that shows the widget; null if there is none.
const QScrollArea* areaAround(const QWidget& widget)
{
    const QWidget* around = widget.parentWidget();
    while (around && !qobject_cast<const QScrollArea*>(around)) around = around->parentWidget();
    return qobject_cast<const QScrollArea*>(around);
}

}  // namespace

PagePreview::PagePreview(QWidget* parent)
    : QWidget(parent), m_choice(choiceBox("previewChoice", tr("Page to preview"), this)), m_picture(new QLabel(this))
{
    m_choice->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    m_picture->setObjectName("previewPicture");
    m_picture->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    m_picture->setMinimumWidth(1);  // the picture follows the page, not the page the picture
    m_picture->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    m_picture->setFrameShape(QFrame::Box);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(8);
    column->addWidget(m_choice);
    column->addWidget(m_picture);
    connect(m_choice, &QComboBox::currentIndexChanged, this, &PagePreview::draw);
}

std::vector<PagePreview::Moment> PagePreview::momentsOf(const Protocol& protocol) const
{
    std::vector<Moment> moments;
    if (m_phase >= 0) {
        const protocols::Phase& phase = protocol.phases[static_cast<std::size_t>(m_phase)];
        for (std::size_t question = 0; question < std::min<std::size_t>(phase.questions.size(), 40); ++question)
            moments.push_back({tr("Question %1").arg(QString::fromStdString(phase.questions[question].id.value)),
                               Presenting{0, static_cast<int>(question), 0, {}, TouchSource::Operator}});
        moments.push_back({tr("Tray before a presentation"), PlacingTray{}});
        moments.push_back({tr("Participant's screen: waiting"), PlacingTray{}, true, {"wait"}});
        moments.push_back({tr("Participant's screen: presentation"), Presenting{}, true, {"feel"}});
    }
    moments.push_back({tr("Participant's screen: welcome"), Enrolled{}, true, {"welcome"}});
    moments.push_back({tr("Consent"), Consenting{}});
    moments.push_back({tr("Participant's screen: consent"), Consenting{}, true, {"consent"}});
    if (!protocol.facts.empty()) {
        moments.push_back({tr("Facts about the participant"), AskingFacts{}});
        moments.push_back({tr("Participant's screen: facts"), AskingFacts{}, true, {"facts"}});
    }
    moments.push_back({tr("Getting to know the display"), Familiarising{}});
    moments.push_back({tr("Participant's screen: getting to know the display"), Familiarising{}, true, {"familiarise"}});
    if (memorisedScaleOf(protocol)) {
        moments.push_back({tr("Learning the scale"), ScaleTraining{}});
        moments.push_back({tr("Participant's screen: scale"), ScaleTraining{}, true, {"scale"}});
    }
    if (!protocol.checklist.empty() || !protocol.readings.empty())
        moments.push_back({tr("Checklist of a sitting"), CheckingList{}});
    moments.push_back({tr("Participant's screen: blindfold"), CheckingList{}, true, {"mask"}});
    moments.push_back({tr("Break"), OnBreak{}});
    moments.push_back({tr("Participant's screen: break"), OnBreak{}, true, {"break"}});
    moments.push_back({tr("Participant's screen: last questions"), Debriefing{}, true, {"last"}});
    moments.push_back({tr("Participant's screen: end"), Finished{}, true, {"end"}});
    return moments;
}

void PagePreview::present(const std::optional<Protocol>& protocol, int phase)
{
    m_phase = protocol ? std::min(phase, static_cast<int>(protocol->phases.size()) - 1) : -1;
    m_protocol = protocol;
    const QString chosen = m_choice->currentText();
    {
        const QSignalBlocker quiet(m_choice);
        m_moments = protocol ? momentsOf(*protocol) : std::vector<Moment>();
        m_choice->clear();
        for (const Moment& moment : m_moments) m_choice->addItem(moment.name);
        m_choice->setCurrentIndex(m_moments.empty() ? -1 : std::max(0, m_choice->findText(chosen)));
    }
    draw();
}

void PagePreview::showQuestion(int question)
{
    for (std::size_t i = 0; i < m_moments.size(); ++i)
        if (const auto* asked = std::get_if<Presenting>(&m_moments[i].stage);
            asked && asked->question == question && !m_moments[i].isOfParticipant) {
            m_choice->setCurrentIndex(static_cast<int>(i));
            return;
        }
}

void PagePreview::showText(const QString& key)
{
    const QString word = key.section(QLatin1Char('_'), 0, 0);
    const auto shown = std::ranges::find_if(m_moments, [&](const Moment& moment) { return moment.texts.contains(word); });
    if (shown != m_moments.end()) m_choice->setCurrentIndex(static_cast<int>(shown - m_moments.begin()));
}

QPixmap PagePreview::pictureOf(const Moment& moment) const
{
    const View view = viewOf(*m_protocol, m_phase, moment.stage);
    // The text grows with the window, and so does the page.
    const QSize size = pageSize * std::max(1.0, scaleOf(window()->size()));
    if (moment.isOfParticipant) {
        ParticipantSide side(nullptr);
        side.show(participant::instructionFor(view, *m_protocol));
        InstructionView screen(side, nullptr);
        screen.resize(size);
        return screen.grab();
    }
    StageStack pages(nullptr);
    pages.begin(factsOf(*m_protocol));
    StagePage& page = pages.pageOf(moment.stage);
    page.present(view);
    pages.bringForward(page);
    pages.resize(size);
    return grabbedAsShown(pages);
}

void PagePreview::draw()
{
    const int chosen = m_choice->currentIndex();
    m_choice->setVisible(!m_moments.empty());
    m_picture->setVisible(!m_moments.empty());
    m_drawn = chosen < 0 ? QPixmap() : pictureOf(m_moments[static_cast<std::size_t>(chosen)]);
    m_picture->setAccessibleName(tr("Preview: %1").arg(m_choice->currentText()));
    fit();
}

/// Width for the picture: that beside a scroll bar, whether there is one or not. Otherwise the bar makes the picture smaller,
/// the smaller picture needs no bar, and both change for ever.
int PagePreview::roomPx() const
{
    const QScrollArea* area = areaAround(*this);
    if (!area) return width();
    const int margin = mapTo(area->widget(), QPoint()).x();
    return std::min(width(), area->maximumViewportSize().width() - area->verticalScrollBar()->sizeHint().width() - 2 * margin);
}

void PagePreview::fit()
{
    if (m_drawn.isNull()) return;
    const int room = std::max(1, roomPx() - 2);
    QPixmap fitted = m_drawn.scaledToWidth(static_cast<int>(room * devicePixelRatioF()), Qt::SmoothTransformation);
    fitted.setDevicePixelRatio(devicePixelRatioF());
    m_picture->setPixmap(fitted);
    m_picture->setFixedHeight(static_cast<int>(fitted.height() / devicePixelRatioF()) + 2);
}

QSize PagePreview::sizeHint() const { return {320, QWidget::sizeHint().height()}; }

void PagePreview::resizeEvent(QResizeEvent* event)
{
    QWidget::resizeEvent(event);
    fit();
}

void PagePreview::changeEvent(QEvent* event)
{
    QWidget::changeEvent(event);
    // The pages take the colours and the size of the text from the window.
    if (event->type() == QEvent::StyleChange && isVisible())
        QMetaObject::invokeMethod(this, &PagePreview::draw, Qt::QueuedConnection);
}

}  // namespace study::app
