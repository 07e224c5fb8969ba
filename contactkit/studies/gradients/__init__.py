"""Gradients of numbers of a result, without automatic differentiation.

of_result    `gradient_of`, what ``result.gradient`` calls.
differences  Differences of what a scene is prepared to, over a parameter.
contact      Of a contact: one adjoint solve with the same operator.
curve        Of the curves of an imposed motion, at gaps of one's own.
motion       Of a separation: sensitivities of the implicit steps.
"""
