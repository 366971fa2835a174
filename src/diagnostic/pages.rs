//! The pages of `hsd explain`: cause, example and fix of every code, from `grammar/diagnostics/`, and in Japanese
//! from the folder `ja` in it.

use super::{Code, Language};

/// The page of a code.
#[derive(Clone, Copy, Debug)]
pub struct Page {
    /// The code.
    pub code: Code,
    /// English.
    pub en: &'static str,
    /// Japanese, with the same examples.
    pub ja: &'static str,
}

impl Page {
    /// Returns the text in the given language.
    pub fn in_language(&self, language: Language) -> &'static str {
        language.choose(self.en, self.ja)
    }
}

/// Includes the page of a number of four digits from both folders.
macro_rules! pages {
    ($($number:literal)*) => {
        &[$(Page {
            code: Code(code($number)),
            en: include_str!(concat!("../../grammar/diagnostics/HSD", $number, ".md")),
            ja: include_str!(concat!("../../grammar/diagnostics/ja/HSD", $number, ".md")),
        }),*]
    };
}

/// All codes with their pages, ascending. A test compares the list with the folder.
pub static PAGES: &[Page] = pages! {
    "0001" "0002" "0003" "0004" "0005" "0006" "0007" "0008"
    "0101" "0102" "0103" "0104" "0105" "0106" "0107" "0108" "0109" "0110" "0111" "0112"
    "0113" "0114" "0115" "0116" "0117" "0118" "0119" "0120" "0121" "0122" "0123" "0124"
    "0125" "0126" "0127" "0128" "0129" "0130" "0131" "0132" "0133" "0134" "0135" "0136"
    "0137" "0138" "0139" "0140" "0141" "0142" "0143" "0144" "0145" "0146" "0147" "0148"
    "0149" "0150" "0151" "0152" "0153" "0154"
    "0201" "0202" "0203" "0204" "0205" "0206" "0207" "0208" "0209" "0210" "0211" "0212"
    "0213" "0214" "0215" "0216" "0217" "0218" "0219" "0220" "0221" "0222" "0223" "0224"
    "0225" "0226" "0227" "0229" "0230" "0231" "0232" "0233" "0234" "0235" "0236"
    "0237" "0238" "0239" "0240" "0241" "0242" "0243" "0244" "0245" "0250" "0251" "0252" "0253"
    "0254" "0255" "0256" "0257" "0258" "0259" "0260" "0261" "0262" "0263" "0264" "0265"
    "0266" "0267" "0268" "0269" "0270" "0271" "0272" "0275" "0276" "0277" "0278" "0279"
    "0280" "0281"
    "0301" "0302" "0303" "0304" "0305" "0306" "0307" "0308" "0309" "0310" "0311" "0312"
    "0313" "0314" "0315" "0316" "0317" "0318" "0319" "0320" "0321" "0322" "0323" "0324"
    "0325" "0326" "0327" "0328" "0329" "0330" "0331" "0332"
    "0401" "0402" "0403" "0404" "0405" "0406" "0407" "0408" "0409" "0410" "0411" "0412"
    "0413" "0417" "0418" "0419" "0420" "0421" "0422" "0423" "0424"
    "0425" "0426" "0427" "0428" "0429" "0430" "0431" "0432" "0433" "0434" "0435" "0436" "0437"
    "0501" "0502" "0503" "0504" "0505" "0506" "0507" "0508" "0509" "0510" "0511" "0512"
    "0513" "0514" "0515" "0516" "0517" "0518" "0519" "0520"
    "0601" "0602" "0603" "0604" "0605"
    "0701" "0702" "0703" "0704"
    "0801" "0802" "0803" "0804" "0805" "0806" "0807" "0808" "0809" "0810" "0811" "0812"
    "0813" "0814" "0815" "0816" "0817" "0818"
    "0901" "0902" "0903" "0904" "0905" "0906" "0907" "0908" "0909" "0910" "0911"
    "1101" "1102" "1103" "1104" "1105" "1106" "1107" "1108" "1109" "1110" "1111" "1112"
    "1113" "1114" "1115" "1116" "1117"
};

/// Parses a number of four digits.
const fn code(digits: &str) -> u16 {
    let (mut number, mut i) = (0, 0);
    while i < digits.len() {
        number = number * 10 + (digits.as_bytes()[i] - b'0') as u16;
        i += 1;
    }
    number
}

/// Returns the page of a code.
pub fn page(code: Code) -> Option<&'static Page> {
    PAGES.iter().find(|page| page.code == code)
}
