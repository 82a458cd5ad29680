// SPDX-License-Identifier: Apache-2.0
import { useEffect } from 'preact/hooks';
import type { Robot } from '../../api/types';
import { Icon } from '../../components/icons';
import { Notice } from '../../components/notice';
import { chosenAge, connected } from '../../lib/chosen';
import { useCommand } from '../../lib/command';
import { answer } from './driving';
import { questionOf, questionWords, waitWords } from './question';

interface Props {
  robot: Robot;
  mayAnswer: boolean; // the account may drive
}

/** Whether this is the destination: the robot asks, and whoever drives it says yes or no. There from the start, so that
 *  screen readers announce a question when it comes. */
export function QuestionCard({ robot, mayAnswer }: Props) {
  const question = questionOf(robot);
  return (
    <>
      <p class="hidden-text" role="alert">
        {question && `${robot.name} asks: ${questionWords(question)}`}
      </p>
      {question && (
        <Asked key={`${question.mission} ${question.number}`} robot={robot} mayAnswer={mayAnswer} />
      )}
    </>
  );
}

function Asked({ robot, mayAnswer }: Props) {
  const { busy, problem, run } = useCommand();
  const question = questionOf(robot);
  useEffect(() => {
    document.getElementById('question')?.scrollIntoView({ block: 'nearest' });
  }, []);
  if (!question) return null;
  const say = (here: boolean) => run(() => answer(robot.id, question.mission, question.number, here));
  return (
    <section id="question" class="card question" aria-labelledby="question-words" data-testid="question">
      <div class="row question-head">
        <Icon name="question" size={36} />
        <h2 id="question-words">{questionWords(question)}</h2>
      </div>
      <p>I am not certain that I have arrived. {waitWords(question, chosenAge.value ?? 0)}</p>
      {mayAnswer ? (
        <div class="question-answers">
          <button
            type="button"
            class="button main"
            disabled={busy || !connected.value}
            onClick={() => say(true)}
          >
            <Icon name="done" size={30} />
            Yes, this is it
          </button>
          <button type="button" class="button" disabled={busy || !connected.value} onClick={() => say(false)}>
            <Icon name="close" size={30} />
            No
          </button>
        </div>
      ) : (
        <p class="soft">Somebody who may drive the chair can answer.</p>
      )}
      {problem && <Notice tone="bad">{problem.message}</Notice>}
    </section>
  );
}
