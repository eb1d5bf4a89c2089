//! Environments as plain numbers, to be gone on with by another process.

use treadmill_humanoid::EpisodeState;
use treadmill_proto::ActorState;
use treadmill_proto::actor_state::{ENVIRONMENT_GENERATORS, GENERATOR_NUMBERS, PROGRESS_NUMBERS};
use treadmill_runtime::seeds;

use super::{Environments, Running};

/// Why a saved state is not gone on with: in words, because only people read it.
type Refusal = String;

impl Environments {
    /// Where all environments are, with the stream of exploration noise that goes with them; `None` if one has faulted
    /// since its reset, which [`Self::step`] lets none be in.
    ///
    /// Who goes on from it does what these environments do after [`Self::renew_worlds`], bit for bit.
    pub fn save(&self, noise: &seeds::Stream) -> Option<ActorState> {
        let mut state = ActorState {
            actor: self.seeds.actor.clone(),
            start: self.seeds.start,
            noise: seeds::words(noise).to_vec(),
            ..ActorState::default()
        };
        for place in &self.places {
            let (episode, running) = (place.environment.episode_state()?, &place.running);
            state.episodes.push(running.number);
            state.lengths.push(episode.steps);
            state.progress.extend([running.return_sum, running.start_x_m, running.last_x_m]);
            state.positions.extend(episode.position);
            state.velocities.extend(episode.velocity);
            state.observations.extend(episode.observation);
            state.past_actions.extend(episode.past_actions);
            state.steps_to_push.push(episode.steps_to_push);
            state.streams.extend(episode.streams.iter().flat_map(seeds::words));
        }
        Some(state)
    }

    /// Goes on where `state`, which is checked as the bus checks it, was saved: the stream of exploration noise.
    ///
    /// # Errors
    /// What does not fit; all environments have been reset then, as if they had just been made.
    pub fn go_on(&mut self, state: &ActorState) -> Result<seeds::Stream, Refusal> {
        let outcome = self.try_go_on(state);
        if outcome.is_err() {
            self.begin();
        }
        outcome
    }

    fn try_go_on(&mut self, state: &ActorState) -> Result<seeds::Stream, Refusal> {
        state.check().map_err(|why| why.to_string())?;
        if state.actor != self.seeds.actor {
            return Err(format!("it is that of actor `{}`, and this is `{}`", state.actor, self.seeds.actor));
        }
        if state.envs() != self.len() {
            return Err(format!("it has {} environments, and here are {}", state.envs(), self.len()));
        }
        // Episodes to come are those of the start that the state is from.
        let mut seeds = self.seeds.clone();
        seeds.start = state.start;
        let rows = self.places.iter_mut().zip(self.observations.chunks_exact_mut(self.observation_size.max(1)));
        for (env, (place, observation)) in rows.enumerate() {
            let number = state.episodes[env];
            let episode = EpisodeState {
                seed: seeds.of(env, number - 1),
                steps: state.lengths[env],
                position: row(&state.positions, env, state).to_vec(),
                velocity: row(&state.velocities, env, state).to_vec(),
                observation: row(&state.observations, env, state).to_vec(),
                past_actions: row(&state.past_actions, env, state).to_vec(),
                steps_to_push: state.steps_to_push[env],
                streams: generators(row(&state.streams, env, state)),
            };
            place.environment.resume_episode(&episode, observation).map_err(|why| why.to_string())?;
            place.precision.round(observation);
            let [return_sum, start_x_m, last_x_m] = part::<PROGRESS_NUMBERS, f64>(&state.progress, env);
            place.running = Running { number, length: episode.steps, return_sum, start_x_m, last_x_m };
        }
        self.seeds = seeds;
        Ok(seeds::from_words(part(&state.noise, 0)))
    }
}

/// What is one environment's of numbers that are checked to be as many for each.
fn row<'a, T>(numbers: &'a [T], env: usize, state: &ActorState) -> &'a [T] {
    let width = numbers.len() / state.envs();
    &numbers[env * width..][..width]
}

fn generators(words: &[u64]) -> [seeds::Stream; ENVIRONMENT_GENERATORS] {
    std::array::from_fn(|index| seeds::from_words(part::<GENERATOR_NUMBERS, u64>(words, index)))
}

fn part<const WIDTH: usize, T: Copy>(numbers: &[T], index: usize) -> [T; WIDTH] {
    std::array::from_fn(|entry| numbers[index * WIDTH + entry])
}
