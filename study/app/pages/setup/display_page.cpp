#include "study/app/pages/setup/display_page.h"

#include <QAbstractItemView>
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>
#include <QVBoxLayout>
#include <array>

#include "protocols/files/typed_number.h"
#include "study/app/language/below.h"
#include "study/app/pages/stage_page.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pattern_buttons.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

struct KindOfDisplay {
    const char* prefix;  ///< of the specification
    QString name, caption, example;
};

std::array<KindOfDisplay, 5> kindsOfDisplays()
{
    return {{{"none", DisplayPage::tr("No display"), {}, {}},
             {"exec:", DisplayPage::tr("Driver program"), DisplayPage::tr("Command that starts the driver"),
              DisplayPage::tr("/opt/display/driver --port 3")},
             {"tcp:", DisplayPage::tr("Driver on another computer"), DisplayPage::tr("Host and port of the driver"),
              DisplayPage::tr("192.168.1.20:7000")},
             {"cover:", DisplayPage::tr("Cover of a touch screen, without a device"),
              DisplayPage::tr("Number of the screen, from 0"), DisplayPage::tr("1")},
             {"folder:", DisplayPage::tr("Folder with plain images"), DisplayPage::tr("Folder that the device watches"),
              DisplayPage::tr("/run/display")}}};
}

}  // namespace

DisplayPage::DisplayPage(const AppOptions& options, QWidget* parent)
    : QWidget(parent),
      m_settings(options.settings),
      m_tried(new TriedDisplay(options.openDisplay, this)),
      m_kind(new QComboBox(this)),
      m_caption(quietLabel("displayArgumentCaption", this)),
      m_argument(field("displayArgumentField", tr("Address of the display"), this)),
      m_connect(mainButton("connectDisplayButton", tr("Connect (Enter)"), this)),
      m_rehearse(button("rehearseButton", tr("Rehearse without a display"), this)),
      m_back(plainButton("displayBackButton", tr("Back (Esc)"), this)),
      m_state(label("displayState", Type::Lead, this, Weight::Bold)),
      m_about(label("displayAbout", Type::Body, this)),
      m_scale(field("displayScaleField", tr("Width of one pixel, mm"), this)),
      m_patterns(new PatternButtons(this)),
      m_shown(label("patternShown", Type::Body, this, Weight::Bold)),
      m_message(new MessageBar("displayMessage", this))
{
    setObjectName("displayPage");
    name(*m_kind, "displayKind", tr("Kind of display"));
    name(*m_kind->view(), "displayKinds", tr("Kinds of displays"));
    for (const KindOfDisplay& kind : kindsOfDisplays())
        if (options.allowsPlainImages || !leavesPlainImages(kind.prefix))
            m_kind->addItem(kind.name, QString::fromLatin1(kind.prefix));
    build();
    connect(m_kind, &QComboBox::currentIndexChanged, this, &DisplayPage::chooseKind);
    connect(m_kind, &QComboBox::currentIndexChanged, m_message, &MessageBar::clearMessage);
    connect(m_argument, &QLineEdit::textChanged, m_message, &MessageBar::clearMessage);
    connect(m_connect, &QPushButton::clicked, this, &DisplayPage::pressConnect);
    connect(m_rehearse, &QPushButton::clicked, this, &DisplayPage::rehearsalRequested);
    connect(m_back, &QPushButton::clicked, this, &DisplayPage::backRequested);
    connect(m_scale, &QLineEdit::textEdited, this, &DisplayPage::readScale);
    connect(m_patterns, &PatternButtons::patternRequested, this, &DisplayPage::showPattern);
    connect(m_tried, &TriedDisplay::opened, this, &DisplayPage::useConnected);
    connect(m_tried, &TriedDisplay::failed, this, &DisplayPage::showConnectFault);
    connect(m_tried, &TriedDisplay::lost, this, &DisplayPage::showFault);
    connect(m_tried, &TriedDisplay::touched, this, [this] {
        ++m_touches;
        showState();
    });
}

void DisplayPage::build()
{
    setType(*m_kind, Type::Body);
    m_scale->setMaximumWidth(520);
    m_scale->setPlaceholderText(tr("not measured"));
    auto* page = new QWidget(this);
    auto* head = new PageHead(page);
    head->setTexts(tr("Display"), tr("Connect the haptic display and feel a test pattern before the participant comes."));
    auto* kindCaption = quietLabel("displayKindCaption", page);
    kindCaption->setText(tr("Kind of display"));
    auto* patternsTitle = label("patternsTitle", Type::Lead, page, Weight::Bold);
    patternsTitle->setText(tr("Test patterns"));
    auto* scaleCaption = quietLabel("displayScaleCaption", page);
    scaleCaption->setText(
        tr("Width of one pixel in mm. Gratings need it: divide the width of the active area by its number of pixels."));
    auto* column = new QVBoxLayout(page);
    column->setSpacing(8);
    column->addWidget(head);
    column->addWidget(kindCaption);
    column->addWidget(m_kind);
    column->addWidget(m_caption);
    column->addWidget(m_argument);
    column->addLayout(actionsRow({m_connect, m_rehearse, m_back}));
    column->addWidget(m_message);
    column->addWidget(m_state);
    column->addWidget(m_about);
    column->addSpacing(10);
    column->addWidget(patternsTitle);
    column->addWidget(m_shown);
    column->addWidget(m_patterns);
    column->addWidget(scaleCaption);
    column->addWidget(m_scale);
    column->addStretch(1);
    column->addWidget(appearanceHint(page));
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(scrolling("displayArea", page, this));
}

void DisplayPage::present(const std::string& specification, const QString& why)
{
    const QString text = QString::fromStdString(specification);
    m_kind->setCurrentIndex(0);
    m_argument->clear();
    for (int item = 1; item < m_kind->count(); ++item) {
        const QString prefix = m_kind->itemData(item).toString();
        if (!text.startsWith(prefix)) continue;
        m_kind->setCurrentIndex(item);
        m_argument->setText(text.mid(prefix.size()));
    }
    chooseKind();
    m_message->clearMessage();
    m_message->standBelow(*m_connect);
    if (!why.isEmpty()) m_message->showHint(why);
}

void DisplayPage::focusFirst()
{
    if (m_argument->isVisibleTo(this))
        m_argument->setFocus();
    else
        m_kind->setFocus();
}

void DisplayPage::chooseKind()
{
    const QString prefix = m_kind->currentData().toString();
    for (const KindOfDisplay& kind : kindsOfDisplays()) {
        if (prefix != QLatin1String(kind.prefix)) continue;
        showText(*m_caption, kind.caption);
        m_argument->setVisible(!kind.caption.isEmpty());
        m_argument->setPlaceholderText(kind.example);
        if (!kind.caption.isEmpty()) m_argument->setAccessibleName(kind.caption);
    }
    m_tried->close();
    const auto known = rememberedScale(m_settings.get(), specification());
    m_scale->setText(known ? QString::number(*known) : QString());
    showState();
}

std::string DisplayPage::specification() const
{
    const QString kind = m_kind->currentData().toString();
    return (kind.endsWith(QLatin1Char(':')) ? kind + m_argument->text().trimmed() : kind).toStdString();
}

std::optional<double> DisplayPage::scale() const
{
    bool isNumber = false;
    const double mm = QString::fromStdString(protocols::typedNumber(m_scale->text().toStdString())).toDouble(&isNumber);
    return isNumber && mm > 0 && mm <= largestMmPerPixel ? std::optional(mm) : std::nullopt;
}

void DisplayPage::connectDisplay()
{
    m_message->clearMessage();
    m_touches = 0;
    m_connected = specification();
    m_tried->connectTo(m_connected);
    if (m_tried->isConnecting()) showConnecting(true);
}

void DisplayPage::pressConnect()
{
    if (m_tried->isConnecting())
        stopConnecting();
    else
        connectDisplay();
}

void DisplayPage::stopConnecting()
{
    m_tried->close();
    showState();
    m_message->standBelow(*m_connect);
    m_message->showHint(tr("Connecting was stopped. The display is not connected."));
}

/// While the display is being connected, nothing can be changed; the button stops it.
void DisplayPage::showConnecting(bool isConnecting)
{
    if (isConnecting == !m_kind->isEnabled()) return;
    if (isConnecting) m_focusBefore = focusWidget();
    setButtonText(*m_connect, isConnecting ? tr("Stop (Esc)") : tr("Connect (Enter)"));
    m_connect->setFocus();
    for (QWidget* control : {static_cast<QWidget*>(m_kind), static_cast<QWidget*>(m_argument), static_cast<QWidget*>(m_rehearse),
                             static_cast<QWidget*>(m_scale), static_cast<QWidget*>(m_back)})
        control->setEnabled(!isConnecting);
    if (isConnecting) {
        m_state->setText(
            tr("Connecting… The driver has up to 10 seconds to answer."));  // DriverPatience and the end of its program
        showText(*m_about, {});
        m_patterns->setUsable(false, {});
    } else if (m_focusBefore && isVisible()) {
        m_focusBefore->setFocus();
    }
}

void DisplayPage::showConnectFault(const QString& text)
{
    showState();
    m_message->standBelow(m_argument->isVisibleTo(this) ? *m_argument : static_cast<QWidget&>(*m_kind));
    m_message->showFault(text);
}

void DisplayPage::useConnected()
{
    rememberDisplay(m_settings.get(), m_connected);
    const auto known = rememberedScale(m_settings.get(), m_connected);
    if (known)
        m_scale->setText(QString::number(*known));
    else if (const auto typed = scale())
        rememberScale(m_settings.get(), m_connected, *typed);
    showState();
    m_message->standBelow(*m_connect);
    if (m_tried->display()->isThere())
        m_message->showDone(tr("The display is connected. This window uses it from now on, and at the next start."));
    else
        m_message->showHint(tr("Nothing can be felt without a display. A session with a participant needs one."));
    Q_EMIT chosen(QString::fromStdString(m_connected));
}

void DisplayPage::readScale()
{
    const auto typed = scale();
    if (typed && m_tried->isConnected()) rememberScale(m_settings.get(), m_connected, *typed);
    if (m_tried->shown()) showPattern(std::nullopt);  // The shown grating has another scale.
    showState();
}

void DisplayPage::showPattern(const std::optional<TestPattern>& pattern)
{
    m_message->clearMessage();
    try {
        if (pattern)
            m_tried->show(*pattern, scale());
        else
            m_tried->clear();
        showState();
    } catch (const std::exception& fault) {
        showFault(inOwnLanguage(fault.what()));
    }
}

void DisplayPage::showFault(const QString& text)
{
    showState();
    m_message->standBelow(*m_patterns);
    m_message->showFault(text);
}

void DisplayPage::showState()
{
    showConnecting(m_tried->isConnecting());
    if (m_tried->isConnecting()) return;
    const rendering::HapticDisplay* display = m_tried->display();
    const bool isThere = display && display->isThere();
    const QString name = isThere ? QString::fromStdString(display->name()) : QString();
    m_state->setText(isThere ? tr("Connected: %1").arg(shortName(name)) : tr("Not connected"));
    m_state->setToolTip(fullName(name));
    QStringList facts;
    const cv::Size sent = rendering::sessionImagePx();
    if (isThere && display->surfacePx()) {
        facts << tr("%1 × %2 px").arg(display->surfacePx()->width).arg(display->surfacePx()->height);
        if (*display->surfacePx() != sent)
            facts
                << tr("sessions send %1 × %2 px: test the driver with `vis2hap display check`").arg(sent.width).arg(sent.height);
    }
    if (isThere && display->reportsTouches()) facts << tr("reports touches (%1 so far)").arg(m_touches);
    if (isThere && !display->reportsTouches()) facts << tr("does not report touches: press T at the first touch");
    const bool takesTickets = isThere && display->fetchesImages();
    if (takesTickets) facts << tr("takes its images from the server only: no test patterns");
    showText(*m_about, facts.join(QStringLiteral("  ·  ")));
    m_patterns->setUsable(isThere && !takesTickets, scale());
    m_patterns->setShown(m_tried->shown());
    m_shown->setText(m_tried->shown() ? tr("On: %1").arg(patternName(*m_tried->shown())) : tr("Off: nothing can be felt"));
}

void DisplayPage::hideEvent(QHideEvent* event)
{
    QWidget::hideEvent(event);
    m_tried->close();
    showState();
}

void DisplayPage::keyPressEvent(QKeyEvent* event)
{
    auto* pressed = qobject_cast<QPushButton*>(focusWidget());
    if (event->key() == Qt::Key_Escape && m_tried->isConnecting())
        stopConnecting();
    else if (event->key() == Qt::Key_Escape)
        Q_EMIT backRequested();
    else if (isEnter(event->key()) && m_tried->isConnecting())
        event->accept();  // A key that bounces must not stop what it began.
    else if (isEnter(event->key()) && pressed)
        pressed->click();
    else if (isEnter(event->key()))
        connectDisplay();
    else
        QWidget::keyPressEvent(event);
}

}  // namespace study::app
