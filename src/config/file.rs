//! The file as it stands, every value with its place. Nothing here has a default: what the author
//! did not write is `None`, so that a curve can be laid over the file and the axis over a curve.

use super::drawing::{
    AutocorrelationTable, ImpulseLawTable, IndependenceTable, LayoutTable, RegionTable, TraceTable,
};
use super::error::{ConfigError, Source};
use super::value::{Critical, Number, Whole};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::ops::Range;
use toml::Spanned;

/// A table of the file whose values are all optional.
macro_rules! section {
    ($(#[$doc:meta])* $name:ident { $($key:ident: $kind:ty),* $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Debug, Default, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(super) struct $name {
            $(pub $key: Option<Spanned<$kind>>),*
        }

        impl $name {
            /// This section where it says something, `base` where it does not.
            fn over(&self, base: &Self) -> Self {
                Self { $($key: self.$key.clone().or_else(|| base.$key.clone())),* }
            }

            /// The keys that are written, each with the place of its value.
            fn written(&self) -> Vec<(&'static str, Range<usize>)> {
                let keys = [$((stringify!($key), self.span(stringify!($key)))),*];
                keys.into_iter().filter_map(|(key, span)| Some((key, span?))).collect()
            }

            /// Where the value of `key` stands.
            pub fn span(&self, key: &str) -> Option<Range<usize>> {
                match key {
                    $(stringify!($key) => self.$key.as_ref().map(Spanned::span),)*
                    _ => None,
                }
            }
        }
    };
}

section! {
    /// `[sensor]`, exactly one of its keys.
    SensorSection { model: Model, ar: Vec<Number>, transfer: TransferTable }
}
section! {
    /// `[noise]`
    NoiseSection { law: LawKind, quantum: Number, range: Number }
}
section! {
    /// `[motion]`
    MotionSection {
        delta: Number, profile: ProfileKind, delta_at: DeltaAtKind, duration: Whole, offset: Whole,
    }
}
section! {
    /// `[impulses]`
    ImpulsesSection { nu: Number, theta: Number, during: DuringKind }
}
section! {
    /// `[whitening]`
    WhiteningSection { order: Whole, training: Whole, fit: FitKind, includes_reference: bool }
}
section! {
    /// `[samples]`
    SamplesSection {
        reference: Whole, shift: Whole, scale: Whole, gap: Whole, decimation: Whole,
    }
}
section! {
    /// `[detector]`
    DetectorSection { alpha: Number, rule: RuleKind, alternative: AlternativeKind }
}

/// The sections that a file has and a curve may change.
#[derive(Clone, Debug)]
pub(super) struct Sections {
    pub sensor: SensorSection,
    pub noise: NoiseSection,
    pub motion: MotionSection,
    pub impulses: ImpulsesSection,
    pub whitening: WhiteningSection,
    pub samples: SamplesSection,
    pub detector: DetectorSection,
}

impl Sections {
    /// These sections where they say something, `base` where they do not. A sensor is one choice:
    /// naming any replaces the other.
    pub fn over(&self, base: &Self) -> Self {
        let sensor = &self.sensor;
        let is_named = sensor.model.is_some() || sensor.ar.is_some() || sensor.transfer.is_some();
        Self {
            sensor: match is_named {
                true => sensor.clone(),
                false => sensor.over(&base.sensor),
            },
            noise: self.noise.over(&base.noise),
            motion: self.motion.over(&base.motion),
            impulses: self.impulses.over(&base.impulses),
            whitening: self.whitening.over(&base.whitening),
            samples: self.samples.over(&base.samples),
            detector: self.detector.over(&base.detector),
        }
    }
}

impl Sections {
    /// Every section and key that is written, with the place of its value.
    pub fn written(&self) -> Vec<(&'static str, &'static str, Range<usize>)> {
        let sections = [
            ("sensor", self.sensor.written()),
            ("noise", self.noise.written()),
            ("motion", self.motion.written()),
            ("impulses", self.impulses.written()),
            ("whitening", self.whitening.written()),
            ("samples", self.samples.written()),
            ("detector", self.detector.written()),
        ];
        let keys = sections.into_iter().flat_map(|(section, keys)| {
            keys.into_iter()
                .map(move |(key, span)| (section, key, span))
        });
        keys.collect()
    }
}

/// A struct with the sections beside its own keys. (`flatten` would lose the place of an error.)
macro_rules! with_sections {
    ($(#[$doc:meta])* $name:ident { $($(#[$attribute:meta])* $key:ident: $kind:ty),* $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Debug, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(super) struct $name {
            $($(#[$attribute])* pub $key: $kind,)*
            #[serde(default)]
            sensor: SensorSection,
            #[serde(default)]
            noise: NoiseSection,
            #[serde(default)]
            motion: MotionSection,
            #[serde(default)]
            impulses: ImpulsesSection,
            #[serde(default)]
            whitening: WhiteningSection,
            #[serde(default)]
            samples: SamplesSection,
            #[serde(default)]
            detector: DetectorSection,
        }

        impl $name {
            pub fn sections(&self) -> Sections {
                Sections {
                    sensor: self.sensor.clone(),
                    noise: self.noise.clone(),
                    motion: self.motion.clone(),
                    impulses: self.impulses.clone(),
                    whitening: self.whitening.clone(),
                    samples: self.samples.clone(),
                    detector: self.detector.clone(),
                }
            }
        }
    };
}

/// What the x axis sweeps, before it is known to be one thing.
pub(super) type AxisTable = Spanned<BTreeMap<Spanned<String>, Spanned<toml::Value>>>;

with_sections! {
    /// The whole file.
    File {
        question: String,
        seed: Whole,
        trials: Option<Spanned<Whole>>,
        half_width: Option<Spanned<Number>>,
        confidence: Option<Spanned<Number>>,
        common_random_numbers: Option<Spanned<bool>>,
        axis: Option<AxisTable>,
        autocorrelation: Option<Spanned<AutocorrelationTable>>,
        trace: Option<Spanned<TraceTable>>,
        layout: Option<Spanned<LayoutTable>>,
        region: Option<Spanned<RegionTable>>,
        independence: Option<Spanned<IndependenceTable>>,
        impulse_law: Option<Spanned<ImpulseLawTable>>,
        #[serde(default)]
        curve: Vec<CurveTable>,
    }
}

with_sections! {
    /// `[[curve]]`
    CurveTable { label: Option<Spanned<String>> }
}

impl File {
    /// Reads the text.
    pub fn parse(source: &Source) -> Result<Self, ConfigError> {
        let deserializer =
            toml::Deserializer::parse(source.text()).map_err(|error| source.toml("", error))?;
        serde_path_to_error::deserialize(deserializer).map_err(|error| {
            let path = error.path().to_string();
            source.toml(&path, error.into_inner())
        })
    }

    /// The curves, or the one that a file without any stands for.
    pub fn curves(&self) -> Vec<CurveTable> {
        if !self.curve.is_empty() {
            return self.curve.clone();
        }
        vec![CurveTable {
            label: None,
            sensor: SensorSection::default(),
            noise: NoiseSection::default(),
            motion: MotionSection::default(),
            impulses: ImpulsesSection::default(),
            whitening: WhiteningSection::default(),
            samples: SamplesSection::default(),
            detector: DetectorSection::default(),
        }]
    }
}

/// `sensor.model`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Model {
    Adxl105,
}

/// `sensor.transfer`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TransferTable {
    pub a: Number,
    pub b: Number,
    pub c: Number,
    pub period: Number,
}

/// `noise.law`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum LawKind {
    Normal,
    Laplace,
    Logistic,
    Uniform,
    Cauchy,
    StudentT(Number),
    Contaminated { share: Number, scale: Number },
}

/// `motion.profile`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum ProfileKind {
    Rectangular,
    Trapezoid { rise: Number },
}

/// `motion.delta_at`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum DeltaAtKind {
    Record,
    Whitened,
}

/// `impulses.during`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum DuringKind {
    Motion,
    Inertial,
}

/// `whitening.fit`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum FitKind {
    LeastSquares,
    YuleWalker,
    Burg,
    Known,
}

/// `detector.rule`
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum RuleKind {
    Wilcoxon,
    Product,
    Disjunction,
    Conjunction,
    Table(Vec<Critical>),
}

/// `detector.alternative`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum AlternativeKind {
    Greater,
    Less,
    TwoSided,
}
