#include "study/app/pages/new_study_page.h"

#include <QComboBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QProgressBar>
#include <QVBoxLayout>
#include <charconv>
#include <utility>

#include "protocols/files/typed_number.h"
#include "protocols/usual_texts.h"
#include "study/app/language/app_text.h"
#include "study/app/language/fonts.h"
#include "study/app/pages/stage_page.h"
#include "study/app/pieces/pieces.h"
#include "study/app/state/study_making.h"

namespace study::app {

namespace {

constexpr int progressSteps = 1000;

template <class Number>
std::optional<Number> wholeNumberFrom(const QString& typed)
{
    const std::string text = protocols::typedNumber(typed.toStdString());
    Number number = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
    return fault == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// As the command line reads it: without the end of a line that was pasted, and the same letters in the same bytes.
std::string passphraseIn(const QLineEdit& line)
{
    const std::string typed = protocols::withoutLineEnd(line.text().toStdString());
    return QString::fromStdString(typed).normalized(QString::NormalizationForm_C).toStdString();
}

std::filesystem::path pathOf(const QLineEdit& line) { return line.text().trimmed().toStdString(); }

/// Where a dialog for the folder begins: the folder itself, or the one that will hold it. A dialog chooses none that is missing.
QString nearestFolder(const QString& folder)
{
    const QString typed = folder.trimmed();
    return typed.isEmpty() || QFileInfo(typed).isDir() ? typed : QFileInfo(typed).absolutePath();
}

}  // namespace

NewStudyPage::NewStudyPage(MakeStudy make, QWidget* parent)
    : QWidget(parent),
      m_make(std::move(make)),
      m_language(new QComboBox(this)),
      m_participants(field("participantsField", tr("Number of participants"), this)),
      m_seed(field("seedField", tr("Seed of the running orders"), this)),
      m_passphrase(field("passphraseField", tr("Passphrase of the allocation key"), this)),
      m_passphraseAgain(field("passphraseAgainField", tr("The same passphrase again"), this)),
      m_editProtocol(button("editProtocolButton", tr("Make or change a protocol…"), this)),
      m_makeButton(mainButton("makeButton", tr("Create the study (Enter)"), this)),
      m_back(button("backButton", tr("Back (Esc)"), this)),
      m_doing(label("makingText", Type::Body, this)),
      m_bar(new QProgressBar(this)),
      m_message(new MessageBar("newStudyMessage", this))
{
    setObjectName("newStudyPage");
    auto* page = new QWidget(this);
    auto* title = label("newStudyTitle", Type::Title, page, Weight::Bold);
    title->setText(tr("New study"));
    auto* lead = quietLabel("newStudyLead", page);
    lead->setText(
        tr("No data set yet? Go back to “Data set from photographs”. To practise, `vis2hap fabrics make FOLDER` makes one. "
           "Sessions and progress reports need no passphrase. Means before the unblinding, and the unblinding itself, do. Nobody "
           "can restore a lost one."));
    m_participants->setPlaceholderText(tr("empty: the number in the protocol"));
    name(*m_language, "participantsLanguageList", tr("Language of the participants"));
    setType(*m_language, Type::Body);
    for (const std::string& tag : protocols::languagesOfUsualTexts()) {
        const QString language = QString::fromStdString(tag);
        m_language->addItem(nameInList(language), language);
    }
    m_language->setCurrentIndex(std::max(0, m_language->findData(languageOfWindow())));
    m_seed->setText(QStringLiteral("1"));
    name(*m_bar, "makingBar", tr("Progress of creating the study"));
    m_bar->setRange(0, progressSteps);
    m_bar->setTextVisible(false);

    auto* form = m_form = new QGridLayout;
    form->setHorizontalSpacing(16);
    form->setVerticalSpacing(12);
    form->setColumnStretch(1, 1);
    m_study =
        addPath(*form, "newStudyFolderField", tr("Study folder"), tr("a folder that does not exist yet"), Browse::NewFolder);
    m_dataset =
        addPath(*form, "datasetField", tr("Fabric data set"), tr("the folder that contains dataset.json"), Browse::Folder);
    m_protocol = addPath(*form, "protocolField", tr("Protocol file"), tr("empty: the study of the paper"), Browse::File);
    addRow(*form, tr("Language of the participants"), m_language);
    addRow(*form, tr("Participants"), m_participants);
    addRow(*form, tr("Seed"), m_seed);
    addRow(*form, tr("Passphrase"), m_passphrase);
    addRow(*form, tr("Passphrase again"), m_passphraseAgain);
    for (QLineEdit* line : {m_passphrase, m_passphraseAgain}) {
        line->setEchoMode(QLineEdit::Password);
        line->setPlaceholderText(tr("8 characters or more; it seals which condition is shown when"));
    }
    m_inputs.insert(m_inputs.end(), {m_editProtocol, m_participants, m_seed, m_passphrase, m_passphraseAgain, m_makeButton});
    // A protocol file states its own language.
    connect(m_protocol, &QLineEdit::textChanged, this, &NewStudyPage::enable);
    auto* actions = new QHBoxLayout;
    actions->setSpacing(14);
    actions->addWidget(m_makeButton);
    actions->addWidget(m_editProtocol);
    actions->addWidget(m_back);
    actions->addStretch(1);
    auto* column = new QVBoxLayout(page);
    column->setSpacing(12);
    column->addStretch(1);
    column->addWidget(title);
    column->addWidget(lead);
    column->addSpacing(8);
    column->addLayout(form);
    column->addSpacing(8);
    column->addLayout(actions);
    column->addWidget(m_doing);
    column->addWidget(m_bar);
    column->addWidget(m_message);
    column->addStretch(2);
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(scrolling("newStudyArea", page, this));
    QWidget* before = m_study;
    for (QWidget* next : m_inputs) {  // the paths and their dialogs come first, as on the page
        if (next == m_editProtocol) break;
        if (next != m_study) setTabOrder(std::exchange(before, next), next);
    }
    for (QWidget* next : std::initializer_list<QWidget*>{m_language, m_participants, m_seed, m_passphrase, m_passphraseAgain,
                                                         m_makeButton, m_editProtocol, m_back})
        setTabOrder(std::exchange(before, next), next);
    for (QWidget* input : m_inputs)
        if (auto* line = qobject_cast<QLineEdit*>(input))
            connect(line, &QLineEdit::textChanged, m_message, &MessageBar::clearMessage);
    connect(m_makeButton, &QPushButton::clicked, this, &NewStudyPage::make);
    connect(m_back, &QPushButton::clicked, this, &NewStudyPage::goBack);
    connect(m_editProtocol, &QPushButton::clicked, this, [this] { Q_EMIT protocolEditRequested(m_protocol->text().trimmed()); });
    enable();
}

NewStudyPage::~NewStudyPage() = default;

QLineEdit* NewStudyPage::addPath(QGridLayout& form, const char* objectName, const QString& caption, const QString& hint,
                                 Browse browse)
{
    auto* row = new QWidget(this);
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(10);
    auto* line = field(objectName, caption, row);
    line->setPlaceholderText(hint);
    auto* open = button(qPrintable(QLatin1String(objectName) + QLatin1String("Browse")), tr("Browse…"), row);
    open->setAccessibleName(tr("Browse for: %1").arg(caption));
    layout->addWidget(line, 1);
    layout->addWidget(open);
    connect(open, &QPushButton::clicked, this, [this, line, browse] { browseFor(*line, browse); });
    addRow(form, caption, row);
    m_inputs.insert(m_inputs.end(), {line, open});
    return line;
}

void NewStudyPage::addRow(QGridLayout& form, const QString& caption, QWidget* control)
{
    auto* text = quietLabel("formCaption", this);
    text->setText(caption);
    text->setWordWrap(false);
    const int row = form.rowCount() + 1;  // the row between two rows is for the message about the upper one
    form.addWidget(text, row, 0);
    form.addWidget(control, row, 1);
}

void NewStudyPage::placeMessage(QLineEdit* line)
{
    int row = 0, column = 0, rows = 0, columns = 0;
    const bool isInRow = m_form->indexOf(line) < 0;
    m_form->getItemPosition(m_form->indexOf(isInRow ? line->parentWidget() : line), &row, &column, &rows, &columns);
    m_form->addWidget(m_message, row + 1, column);
}

void NewStudyPage::browseFor(QLineEdit& target, Browse browse)
{
    QString chosen;
    if (browse == Browse::File)
        chosen = QFileDialog::getOpenFileName(this, tr("Protocol file"), target.text(), tr("Protocols (*.json)"));
    else
        chosen = QFileDialog::getExistingDirectory(
            this, browse == Browse::Folder ? tr("Fabric data set") : tr("Folder for the new study"),
            nearestFolder(target.text()));
    if (!chosen.isEmpty()) target.setText(browse == Browse::NewFolder ? chosen + QStringLiteral("/study") : chosen);
}

QString NewStudyPage::textOf(protocols::PassphraseFault fault)
{
    switch (fault) {
        case protocols::PassphraseFault::OnlyBlanks:
            return tr("The passphrase holds only blanks. Type letters, digits and signs.");
        case protocols::PassphraseFault::ControlCharacter:
            return tr("The passphrase holds a character that nobody can type, such as a tab. Type it anew.");
        case protocols::PassphraseFault::TooShort:
            break;
    }
    return tr("The passphrase is too short. Type 8 characters or more, such as four words.");
}

std::optional<NewStudyRequest> NewStudyPage::request()
{
    const auto refuse = [this](QLineEdit* line, const QString& text) {
        line->setFocus();
        placeMessage(line);
        m_message->showHint(text);
        return std::nullopt;
    };
    if (m_study->text().trimmed().isEmpty())
        return refuse(m_study, tr("No study folder is given. Type a folder that does not exist yet; the program creates it."));
    if (m_dataset->text().trimmed().isEmpty())
        return refuse(m_dataset, tr("No data set is given. Choose the fabric data set that the stimuli are made from."));
    const auto seed = wholeNumberFrom<std::uint64_t>(m_seed->text());
    if (!seed) return refuse(m_seed, tr("The seed is not valid. Type a whole number, 0 or larger."));
    const std::string passphrase = passphraseIn(*m_passphrase);
    if (const auto fault = protocols::faultOfNewPassphrase(passphrase)) return refuse(m_passphrase, textOf(*fault));
    if (passphrase != passphraseIn(*m_passphraseAgain))
        return refuse(m_passphraseAgain, tr("The two passphrases differ. Type the same one twice."));
    NewStudyRequest filled{pathOf(*m_study), pathOf(*m_dataset), std::nullopt, std::nullopt, *seed, passphrase};
    if (!m_protocol->text().trimmed().isEmpty()) filled.protocol = pathOf(*m_protocol);
    filled.language = m_language->currentData().toString().toStdString();
    if (!m_participants->text().trimmed().isEmpty()) {
        filled.participants = wholeNumberFrom<int>(m_participants->text());
        if (!filled.participants || *filled.participants < 1)
            return refuse(
                m_participants,
                tr("The number of participants is not valid. Type a whole number, 1 or larger, or leave the line empty."));
    }
    return filled;
}

void NewStudyPage::make()
{
    m_message->clearMessage();
    const auto filled = request();
    if (!filled || m_making) return;
    m_making = std::make_unique<StudyMaking>(m_make, *filled, nullptr);
    connect(
        m_making.get(), &StudyMaking::progressed, this,
        [this](double fraction, const QString& what) {
            m_bar->setValue(static_cast<int>(fraction * progressSteps));
            m_doing->setText(what);
        },
        Qt::QueuedConnection);
    connect(
        m_making.get(), &StudyMaking::failed, this,
        [this](const QString& why) {
            end();
            m_message->standBelow(*m_bar);
            m_message->showFault(why);
            fieldOf(why).setFocus();
        },
        Qt::QueuedConnection);
    connect(
        m_making.get(), &StudyMaking::done, this,
        [this](const QStringList& remarks) {
            const QString folder = QString::fromStdString(m_making->request().study.string());
            end();
            Q_EMIT made(folder, remarks);
        },
        Qt::QueuedConnection);
    m_doing->setText(tr("The program creates the study."));
    m_bar->setValue(0);
    enable();
    m_making->begin();
}

QLineEdit& NewStudyPage::fieldOf(const QString& fault) const
{
    QLineEdit* named = m_study;
    qsizetype longest = 0;  // a data set may lie below the folder of the study
    for (QLineEdit* line : {m_study, m_dataset, m_protocol}) {
        const QString path = line->text().trimmed();
        if (path.size() <= longest || !fault.contains(path)) continue;
        longest = path.size();
        named = line;
    }
    return *named;
}

void NewStudyPage::end()
{
    m_making.reset();
    enable();
    focusFirst();
}

void NewStudyPage::enable()
{
    for (QWidget* input : m_inputs) input->setEnabled(!m_making);
    m_language->setEnabled(!m_making && m_protocol->text().trimmed().isEmpty());
    m_doing->setVisible(m_making != nullptr);
    m_bar->setVisible(m_making != nullptr);
    setButtonText(*m_back, m_making ? tr("Cancel (Esc)") : tr("Back (Esc)"));
    if (m_making) m_back->setFocus();
}

void NewStudyPage::goBack()
{
    if (!m_making) {
        m_message->clearMessage();
        Q_EMIT backRequested();
        return;
    }
    m_making->stop();
    m_doing->setText(tr("The program stops this work."));
}

void NewStudyPage::fill(const QString& dataset, const QString& protocol)
{
    m_dataset->setText(dataset);
    m_protocol->setText(protocol);
}

void NewStudyPage::fillProtocol(const QString& protocol) { m_protocol->setText(protocol); }

void NewStudyPage::focusFirst() { m_study->setFocus(); }

void NewStudyPage::keyPressEvent(QKeyEvent* event)
{
    auto* pressed = qobject_cast<QPushButton*>(focusWidget());
    if (event->key() == Qt::Key_Escape)
        goBack();
    else if (isEnter(event->key()) && pressed)
        pressed->click();
    else if (isEnter(event->key()))
        make();
    else
        QWidget::keyPressEvent(event);
}

}  // namespace study::app
