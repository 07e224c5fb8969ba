"""Contact lines that move: dynamic contact angle, liquid left behind, weight of a bridge.

cox_voinov     Apparent contact angle over the capillary number of the line.
moving_bridge  Force of an exact bridge over the gap and both contact angles.
landau_levich  Thickness of the film that a receding meniscus deposits.
weight         Force of the weight of a bridge on each of its bodies, to first order.
"""
