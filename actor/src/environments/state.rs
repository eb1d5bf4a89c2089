//! Saves environments as plain numbers, from which another process continues.

use treadmill_humanoid::EpisodeState;
use treadmill_proto::ActorState;
use treadmill_proto::actor_state::{ENVIRONMENT_GENERATORS, GENERATOR_NUMBERS, PROGRESS_NUMBERS};
use treadmill_runtime::{error_chain, seeds};

use super::{Environments, EpisodeProgress, ResetSeeds};

/// Saves all shares of an actor's environments, in their order, and the stream of exploration noise. Environments that
/// continue from the result behave, bit for bit, as these do.
///
/// Returns `None` if an environment has faulted since its reset, which cannot happen between calls of
/// [`Environments::step`].
pub fn save(shares: &[&Environments], noise: &seeds::Stream) -> Option<ActorState> {
    let ResetSeeds { actor, start, .. } = shares.first()?.seeds.clone();
    let mut state = ActorState { actor, start, noise: seeds::words(noise).to_vec(), ..ActorState::default() };
    for slot in shares.iter().flat_map(|share| share.vector.slots()) {
        let (episode, progress) = (slot.environment.episode_state()?, &slot.kept.progress);
        state.episodes.push(progress.number);
        state.lengths.push(episode.steps);
        state.progress.extend([progress.return_sum, progress.start_x_m, progress.last_x_m]);
        state.positions.extend(episode.position);
        state.velocities.extend(episode.velocity);
        state.observations.extend(episode.observation);
        state.past_actions.extend(episode.past_actions);
        state.steps_to_push.push(episode.steps_to_push);
        state.task.extend(&episode.task);
        state.streams.extend(episode.streams.iter().flat_map(seeds::words));
    }
    Some(state)
}

/// Restores `state` after checking it; returns its stream of exploration noise.
///
/// # Errors
/// Returns why the state does not fit; all environments then begin their first episodes.
pub fn restore(shares: &mut [&mut Environments], state: &ActorState) -> Result<seeds::Stream, String> {
    let envs: usize = shares.iter().map(|share| share.len()).sum();
    let result = state.check().map_err(|error| error_chain(&error)).and_then(|()| {
        if state.envs() != envs {
            return Err(format!("the state has {} environments, this actor has {envs}", state.envs()));
        }
        shares.iter_mut().try_for_each(|share| share.restore_rows(state))
    });
    if result.is_err() {
        shares.iter_mut().for_each(|share| share.reset());
    }
    result.map(|()| seeds::from_words(entries(&state.noise, 0)))
}

impl Environments {
    /// Restores the rows of these environments from a checked state of all.
    fn restore_rows(&mut self, state: &ActorState) -> Result<(), String> {
        if state.actor != self.seeds.actor {
            return Err(format!("the state is of actor `{}`, this actor is `{}`", state.actor, self.seeds.actor));
        }
        // Further episodes take their seeds from the start at which the state was saved.
        let mut seeds = self.seeds.clone();
        seeds.start = state.start;
        for (slot, observation) in self.vector.rows() {
            let env = slot.kept.env;
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
                task: row(&state.task, env, state).to_vec(),
            };
            slot.environment.resume_episode(&episode, observation).map_err(|error| error_chain(&error))?;
            self.precision.round(observation);
            let [return_sum, start_x_m, last_x_m] = entries::<PROGRESS_NUMBERS, f64>(&state.progress, env);
            slot.kept.progress = EpisodeProgress { number, length: episode.steps, return_sum, start_x_m, last_x_m };
        }
        self.seeds = seeds;
        Ok(())
    }
}

/// Returns the numbers of one environment from a checked plane, in which every environment has equally many.
fn row<'a, T>(numbers: &'a [T], env: usize, state: &ActorState) -> &'a [T] {
    let width = numbers.len() / state.envs();
    &numbers[env * width..][..width]
}

fn generators(words: &[u64]) -> [seeds::Stream; ENVIRONMENT_GENERATORS] {
    std::array::from_fn(|index| seeds::from_words(entries::<GENERATOR_NUMBERS, u64>(words, index)))
}

fn entries<const WIDTH: usize, T: Copy>(numbers: &[T], index: usize) -> [T; WIDTH] {
    std::array::from_fn(|entry| numbers[index * WIDTH + entry])
}
