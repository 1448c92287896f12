#include "study/app/pages/setup/participant_page.h"

#include <QAbstractItemView>
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>
#include <QScreen>
#include <QVBoxLayout>

#include "study/app/pages/stage_page.h"
#include "study/app/participant/networks.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

/// "482 913": six digits are easier to read in threes.
QString inThrees(const QString& code) { return code.left(3) + QLatin1Char(' ') + code.mid(3); }

}  // namespace

ParticipantPage::ParticipantPage(ParticipantSide& side, ParticipantSound& sound, QWidget* parent)
    : QWidget(parent),
      m_side(side),
      m_sound(sound),
      m_screen(new QComboBox(this)),
      m_open(mainButton("openWindowButton", tr("Show on this screen (Enter)"), this)),
      m_screenState(label("participantScreenState", Type::Body, this, Weight::Bold)),
      m_network(new QComboBox(this)),
      m_start(button("startPageButton", tr("Start the page"), this)),
      m_newCode(button("newCodeButton", tr("Draw a new code"), this)),
      m_back(plainButton("participantBackButton", tr("Back (Esc)"), this)),
      m_address(label("pageAddress", Type::Title, this, Weight::Bold)),
      m_code(label("pageCode", Type::Title, this, Weight::Bold)),
      m_state(label("pageState", Type::Body, this, Weight::Bold)),
      m_noise(new QComboBox(this)),
      m_speech(new QComboBox(this)),
      m_startSound(button("startSoundButton", tr("Start the sound"), this)),
      m_try(button("tryRecordingButton", tr("Play a prompt"), this)),
      m_soundState(label("soundState", Type::Body, this, Weight::Bold)),
      m_speechState(label("speechState", Type::Body, this)),
      m_message(new MessageBar("participantMessage", this))
{
    setObjectName("participantPage");
    name(*m_screen, "screenChoice", tr("Screen of the participant"));
    name(*m_screen->view(), "screens", tr("Screens"));
    name(*m_network, "networkChoice", tr("Network of the page"));
    name(*m_network->view(), "networks", tr("Networks"));
    name(*m_noise, "noiseChoice", tr("Masking noise"));
    name(*m_noise->view(), "noises", tr("Levels of the masking noise"));
    m_noise->addItem(tr("No noise"), 0.0);
    m_noise->addItem(tr("Quiet noise"), 0.03);
    m_noise->addItem(tr("Medium noise"), 0.08);
    m_noise->addItem(tr("Loud noise"), 0.2);
    m_noise->setCurrentIndex(2);
    name(*m_speech, "speechChoice", tr("Prompts without a recording"));
    name(*m_speech->view(), "speeches", tr("Prompts without a recording"));
    m_speech->addItem(tr("A computer voice speaks prompts without a recording"));
    m_speech->addItem(tr("The operator speaks prompts without a recording"));
    m_address->setTextInteractionFlags(Qt::TextSelectableByMouse);
    build();
    connect(m_open, &QPushButton::clicked, this, &ParticipantPage::toggleWindow);
    connect(m_start, &QPushButton::clicked, this, &ParticipantPage::togglePage);
    connect(m_newCode, &QPushButton::clicked, &m_side, &ParticipantSide::drawCode);
    connect(m_back, &QPushButton::clicked, this, &ParticipantPage::backRequested);
    connect(m_startSound, &QPushButton::clicked, this, &ParticipantPage::toggleSound);
    connect(m_try, &QPushButton::clicked, this, [this] { m_sound.say({m_sound.someKey()}); });
    connect(m_noise, &QComboBox::currentIndexChanged, this, [this] { m_sound.setNoise(noise()); });
    connect(m_speech, &QComboBox::currentIndexChanged, this, [this] { m_sound.setSpeech(speech()); });
    connect(&m_side, &ParticipantSide::stateChanged, this, &ParticipantPage::showState);
    connect(&m_sound, &ParticipantSound::stateChanged, this, &ParticipantPage::showState);
    showState();
}

ParticipantPage::~ParticipantPage() = default;

void ParticipantPage::build()
{
    for (QComboBox* choice : {m_screen, m_network, m_noise, m_speech}) setType(*choice, Type::Body);
    auto* page = new QWidget(this);
    auto* head = new PageHead(page);
    head->setTexts(tr("Participant's screen"),
                   tr("Shows the participant what to do: consent, questions, the scale, breaks. It shows no code, fabric or "
                      "condition. The session works without it at any moment."));
    const auto title = [&](const char* objectName, const QString& text) {
        auto* made = label(objectName, Type::Lead, page, Weight::Bold);
        made->setText(text);
        return made;
    };
    const auto caption = [&](const char* objectName, const QString& text) {
        auto* made = quietLabel(objectName, page);
        made->setText(text);
        return made;
    };
    auto* column = new QVBoxLayout(page);
    column->setSpacing(8);
    column->addWidget(head);
    column->addSpacing(6);
    column->addWidget(title("secondScreenTitle", tr("Second screen of this computer")));
    column->addWidget(m_screen);
    column->addLayout(actionsRow({m_open}));
    column->addWidget(m_screenState);
    column->addSpacing(14);
    column->addWidget(title("tabletTitle", tr("Tablet in the same room")));
    column->addWidget(
        caption("networkCaption", tr("The tablet's browser opens the address and enters the code. The connection is plain "
                                     "HTTP: everybody in the chosen network can read it. Choose a network of your own.")));
    column->addWidget(m_network);
    column->addLayout(actionsRow({m_start, m_newCode}));
    column->addWidget(m_address);
    column->addWidget(m_code);
    column->addWidget(m_state);
    column->addSpacing(14);
    column->addWidget(title("headphonesTitle", tr("Headphones")));
    column->addWidget(m_noise);
    column->addWidget(m_speech);
    column->addLayout(actionsRow({m_startSound, m_try}));
    column->addWidget(m_soundState);
    column->addWidget(m_speechState);
    column->addWidget(m_message);
    column->addLayout(actionsRow({m_back}));
    column->addStretch(1);
    column->addWidget(appearanceHint(page));
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(scrolling("participantArea", page, this));
}

void ParticipantPage::present()
{
    listScreens();
    listNetworks();
    showState();
}

void ParticipantPage::focusFirst() { m_open->setFocus(); }

void ParticipantPage::listScreens()
{
    const QString before = m_screen->currentText();
    m_screen->clear();
    const auto screens = QGuiApplication::screens();
    for (qsizetype i = 0; i < screens.size(); ++i) {
        const QString name = screens[i]->name().isEmpty() ? QString() : QLatin1Char(' ') + screens[i]->name();
        const QString text =
            tr("Screen %1%2, %3 × %4").arg(i + 1).arg(name).arg(screens[i]->size().width()).arg(screens[i]->size().height());
        m_screen->addItem(screens[i] == screen() ? tr("%1 (this one)").arg(text) : text);
        if (screens[i] != screen()) m_screen->setCurrentIndex(static_cast<int>(i));
    }
    if (const int known = m_screen->findText(before); known >= 0) m_screen->setCurrentIndex(known);
}

void ParticipantPage::listNetworks()
{
    const QString before = m_network->currentData().toString();
    m_network->clear();
    m_network->addItem(tr("This computer only: 127.0.0.1"), QStringLiteral("127.0.0.1"));
    for (const Network& network : networksOfThisComputer())
        m_network->addItem(tr("%1: %2 (readable in this network)").arg(network.name, network.address), network.address);
    if (const int known = m_network->findData(before); known >= 0) m_network->setCurrentIndex(known);
}

void ParticipantPage::toggleWindow()
{
    if (m_window) return closeWindow();
    const auto screens = QGuiApplication::screens();
    const int chosen = m_screen->currentIndex();
    if (chosen < 0 || chosen >= screens.size()) {
        present();
        return m_message->showHint(tr("This screen is not connected any more. Choose another one."));
    }
    m_window = std::make_unique<ParticipantWindow>(m_side, *screens[chosen], *screen());
    connect(m_window.get(), &ParticipantWindow::closed, this, &ParticipantPage::closeWindow);
    showState();
}

void ParticipantPage::closeWindow()
{
    m_window.reset();
    showState();
}

void ParticipantPage::togglePage()
{
    m_message->clearMessage();
    if (m_side.state().isOn)
        m_side.stopPage();
    else
        m_side.startPage(m_network->currentData().toString());
}

double ParticipantPage::noise() const { return m_noise->currentData().toDouble(); }

void ParticipantPage::toggleSound()
{
    if (m_sound.state().isOn)
        m_sound.stop();
    else
        m_sound.start(noise(), speech());
}

Speech ParticipantPage::speech() const { return m_speech->currentIndex() == 0 ? Speech::Wanted : Speech::RecordingsOnly; }

QString ParticipantPage::promptsText() const
{
    const SoundState& sound = m_sound.state();
    const QString recordings =
        sound.recordings == 0 ? tr("The study names no recordings.") : tr("Recordings of the study: %1.").arg(sound.recordings);
    if (!sound.voice.isEmpty()) return tr("%1 The voice %2 speaks the other prompts.").arg(recordings, sound.voice);
    if (sound.isOn || speech() == Speech::RecordingsOnly) return tr("%1 The operator speaks the other prompts.").arg(recordings);
    return recordings;
}

void ParticipantPage::showSound()
{
    const SoundState& sound = m_sound.state();
    setButtonText(*m_startSound, sound.isOn ? tr("Stop the sound") : tr("Start the sound"));
    m_try->setEnabled(sound.isOn && !m_sound.someKey().empty());
    m_soundState->setText(sound.isOn && !sound.device.isEmpty() ? tr("Playing on %1. %2").arg(sound.device, promptsText())
                                                                : promptsText());
    showText(*m_speechState, sound.noVoice);
}

void ParticipantPage::showState()
{
    const PageState& state = m_side.state();
    setButtonText(*m_open, m_window ? tr("Close the window (Enter)") : tr("Show on this screen (Enter)"));
    m_screen->setEnabled(!m_window);
    showText(*m_screenState, m_window ? tr("The participant's window is open.") : QString());
    setButtonText(*m_start, state.isOn ? tr("Stop the page") : tr("Start the page"));
    m_network->setEnabled(!state.isOn);
    m_newCode->setEnabled(state.isOn);
    showText(*m_address, state.isOn ? state.address : QString());
    showText(*m_code, state.code.isEmpty() || state.address.isEmpty() ? QString() : tr("Code: %1").arg(inThrees(state.code)));
    QString text;
    if (!state.device.isEmpty())
        text = tr("A browser at %1 shows the page. To use another one, draw a new code.").arg(state.device) +
               (state.refused.isEmpty() ? QString() : tr(" Another browser at %1 was refused.").arg(state.refused));
    else if (state.isOn && state.code.isEmpty())
        text = tr("The code is void after %1 wrong tries. Draw a new code.").arg(state.wrongCodes);
    else if (state.isOn)
        text = state.wrongCodes == 0 ? tr("No browser has entered the code yet.")
                                     : tr("No browser has entered the code yet. Wrong codes: %1").arg(state.wrongCodes);
    showText(*m_state, text);
    showSound();
    const QString fault = state.fault.isEmpty() ? m_sound.state().fault : state.fault;
    if (fault.isEmpty())
        m_message->clearMessage();
    else
        m_message->showFault(fault);
}

void ParticipantPage::keyPressEvent(QKeyEvent* event)
{
    auto* pressed = qobject_cast<QPushButton*>(focusWidget());
    if (event->key() == Qt::Key_Escape)
        Q_EMIT backRequested();
    else if (isEnter(event->key()) && pressed)
        pressed->click();
    else
        QWidget::keyPressEvent(event);
}

}  // namespace study::app
